#include "assets/generate/noise.h"

#include <array>
#include <cmath>

namespace raylab::assets {
namespace {

uint32_t mixBits(uint32_t h) {
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    return h ^ (h >> 16);
}

uint32_t hash(uint32_t x, uint32_t y, uint32_t z) {
    return mixBits(x * 0x9e3779b1u ^ y * 0x85ebca77u ^ z * 0xc2b2ae3du);
}

float fade(float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }

/// Largest integer at most x; std::floor is a library call without SSE 4.1.
int floorToInt(float x) {
    const int truncated = static_cast<int>(x);
    return truncated - (x < static_cast<float>(truncated) ? 1 : 0);
}

std::array<glm::vec2, 256> makeDirections() {
    std::array<glm::vec2, 256> directions{};
    for (size_t i = 0; i < directions.size(); ++i) {
        const float angle = static_cast<float>(i) * (6.2831853f / 256.0f);
        directions[i] = {std::cos(angle), std::sin(angle)};
    }
    return directions;
}

const std::array<glm::vec2, 256> kDirections = makeDirections();

float gradient2(uint32_t h, float x, float y) {
    const glm::vec2 direction = kDirections[h & 0xffu];
    return direction.x * x + direction.y * y;
}

/// One of the twelve edges of a cube, as in the paper.
float gradient3(uint32_t h, glm::vec3 p) {
    const uint32_t edge = h & 15u;
    const float u = edge < 8 ? p.x : p.y;
    const float v = edge < 4 ? p.y : (edge == 12 || edge == 14 ? p.x : p.z);
    return ((edge & 1u) != 0 ? -u : u) + ((edge & 2u) != 0 ? -v : v);
}

}  // namespace

float hash01(uint32_t x, uint32_t y, uint32_t seed) {
    return static_cast<float>(hash(x, y, seed) >> 8) * (1.0f / 16777216.0f);
}

float tileNoise(glm::vec2 p, glm::uvec2 period, uint32_t seed) {
    const glm::ivec2 cell(floorToInt(p.x), floorToInt(p.y));
    const glm::vec2 f = p - glm::vec2(cell);
    const auto wrap = [](int c, uint32_t n) {
        const int remainder = c % static_cast<int>(n);
        return static_cast<uint32_t>(remainder < 0 ? remainder + static_cast<int>(n) : remainder);
    };
    const uint32_t x0 = wrap(cell.x, period.x);
    const uint32_t y0 = wrap(cell.y, period.y);
    const uint32_t x1 = (x0 + 1) % period.x;
    const uint32_t y1 = (y0 + 1) % period.y;
    const float a = gradient2(hash(x0, y0, seed), f.x, f.y);
    const float b = gradient2(hash(x1, y0, seed), f.x - 1.0f, f.y);
    const float c = gradient2(hash(x0, y1, seed), f.x, f.y - 1.0f);
    const float d = gradient2(hash(x1, y1, seed), f.x - 1.0f, f.y - 1.0f);
    return 1.4f * glm::mix(glm::mix(a, b, fade(f.x)), glm::mix(c, d, fade(f.x)), fade(f.y));
}

float tileFbm(glm::vec2 uv, glm::uvec2 cells, uint32_t octaves, uint32_t seed) {
    float sum = 0.0f;
    float amplitude = 0.5f;
    for (uint32_t i = 0; i < octaves; ++i) {
        sum += amplitude * tileNoise(uv * glm::vec2(cells), cells, seed + i);
        cells *= 2u;
        amplitude *= 0.5f;
    }
    return sum;
}

float noise3(glm::vec3 p, uint32_t seed) {
    const glm::ivec3 i(floorToInt(p.x), floorToInt(p.y), floorToInt(p.z));
    const glm::vec3 f = p - glm::vec3(i);
    const glm::vec3 w(fade(f.x), fade(f.y), fade(f.z));
    float planes[2];
    for (int dz = 0; dz < 2; ++dz) {
        float rows[2];
        for (int dy = 0; dy < 2; ++dy) {
            float ends[2];
            for (int dx = 0; dx < 2; ++dx) {
                const uint32_t h = hash(static_cast<uint32_t>(i.x + dx), static_cast<uint32_t>(i.y + dy),
                                        static_cast<uint32_t>(i.z + dz) + 0x1000193u * seed);
                ends[dx] = gradient3(h, f - glm::vec3(dx, dy, dz));
            }
            rows[dy] = glm::mix(ends[0], ends[1], w.x);
        }
        planes[dz] = glm::mix(rows[0], rows[1], w.y);
    }
    return glm::mix(planes[0], planes[1], w.z);
}

}  // namespace raylab::assets
