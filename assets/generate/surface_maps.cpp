#include "assets/generate/surface_maps.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <stdexcept>

namespace raylab::assets {
namespace {

uint8_t toByte(float value) { return static_cast<uint8_t>(glm::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

void appendBytes(void* context, void* data, int sizeBytes) {
    auto& png = *static_cast<std::vector<uint8_t>*>(context);
    const auto* bytes = static_cast<const uint8_t*>(data);
    png.insert(png.end(), bytes, bytes + sizeBytes);
}

std::vector<uint8_t> encodePng(const std::vector<uint8_t>& texels, uint32_t size, int channels) {
    std::vector<uint8_t> png;
    const int side = static_cast<int>(size);
    if (stbi_write_png_to_func(appendBytes, &png, side, side, channels, texels.data(), side * channels) == 0) {
        throw std::runtime_error("cannot encode a PNG: out of memory?");
    }
    return png;
}

/// `texel(x, y)` returns the channels as a glm vector.
template <int channels, typename Texel>
std::vector<uint8_t> encodeImage(uint32_t size, Texel&& texel) {
    std::vector<uint8_t> texels(static_cast<size_t>(size) * size * channels);
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            const glm::vec<channels, float> value = texel(x, y);
            for (int c = 0; c < channels; ++c) {
                texels[(static_cast<size_t>(y) * size + x) * channels + static_cast<size_t>(c)] = toByte(value[c]);
            }
        }
    }
    return encodePng(texels, size, channels);
}

}  // namespace

SurfaceMaps paintSurface(const PaintConfig& config, const std::function<SurfacePoint(glm::vec2)>& paint) {
    const uint32_t size = config.size;
    std::vector<SurfacePoint> points(static_cast<size_t>(size) * size);
    tbb::parallel_for(0u, size, [&](uint32_t y) {
        for (uint32_t x = 0; x < size; ++x) {
            points[static_cast<size_t>(y) * size + x] = paint((glm::vec2(x, y) + 0.5f) / static_cast<float>(size));
        }
    });
    const auto at = [&](uint32_t x, uint32_t y) -> const SurfacePoint& {
        return points[static_cast<size_t>(y % size) * size + x % size];
    };
    const float twoTexels = 2.0f * config.metres / static_cast<float>(size);
    const auto normalAt = [&](uint32_t x, uint32_t y) {
        const float right = (at(x + 1, y).height - at(x + size - 1, y).height) / twoTexels;
        const float down = (at(x, y + 1).height - at(x, y + size - 1).height) / twoTexels;
        return glm::normalize(glm::vec3(-right, down, 1.0f)) * 0.5f + 0.5f;
    };

    SurfaceMaps maps;
    const auto encodeColour = [&] {
        if (config.alpha) {
            maps.baseColor = encodeImage<4>(
                size, [&](uint32_t x, uint32_t y) { return glm::vec4(at(x, y).colour, at(x, y).alpha); });
        } else {
            maps.baseColor = encodeImage<3>(size, [&](uint32_t x, uint32_t y) { return at(x, y).colour; });
        }
    };
    const auto encodeRoughness = [&] {
        if (!config.roughness) return;
        maps.metallicRoughness = encodeImage<3>(
            size, [&](uint32_t x, uint32_t y) { return glm::vec3(1.0f, at(x, y).roughness, at(x, y).metallic); });
    };
    const auto encodeNormals = [&] {
        if (config.relief) maps.normal = encodeImage<3>(size, normalAt);
    };
    tbb::parallel_invoke(encodeColour, encodeRoughness, encodeNormals);
    return maps;
}

}  // namespace raylab::assets
