#include <algorithm>
#include <cmath>

#include "engine/measure/hit_oracle_surface.h"

namespace raylab::oracle {
namespace {

/// Of alpha itself: decoding, two weights, three products and sums, the factor.
constexpr double kAlphaRoundings = 8.0;
/// Of a texture coordinate: two products and sums, the fraction, the product with the size, the half texel.
constexpr double kUvRoundings = 8.0;

/// Wellons' hash "lowbias32" and the combination of two, as shaders/lib/random.glsl has them: the rule that is judged
/// names the number, so there is no other way to it.
uint32_t hashUint(uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

uint32_t hashCombine(uint32_t a, uint32_t b) { return hashUint(a ^ (hashUint(b) + 0x9e3779b9u + (a << 6) + (a >> 2))); }

/// In [0, 1), 24 bits.
double blendCutoff(uint32_t key, const Candidate& hit) {
    return static_cast<double>(hashCombine(hashCombine(key, hit.instance), hit.primitive) >> 8) * 0x1p-24;
}

int64_t wrap(int64_t x, int64_t size, Wrap mode) {
    if (mode == Wrap::clamp) return std::clamp<int64_t>(x, 0, size - 1);
    const int64_t period = mode == Wrap::mirror ? 2 * size : size;
    const int64_t inPeriod = ((x % period) + period) % period;
    return inPeriod < size ? inPeriod : period - 1 - inPeriod;
}

double alphaTexel(const Texture& texture, int64_t x, int64_t y) {
    const auto column = static_cast<size_t>(wrap(x, texture.width, texture.wrapU));
    const auto row = static_cast<size_t>(wrap(y, texture.height, texture.wrapV));
    return static_cast<double>(texture.texels[row * texture.width + column] >> 24) / 255.0;
}

struct Alpha {
    double value;
    double error;
};

/// Bilinear, `uvError` being how far the place may be off. Bilinear interpolation changes by no more a texel than
/// neighbours differ.
Alpha sample(const Texture& texture, const glm::dvec2& uv, const glm::dvec2& uvError) {
    const glm::dvec2 size(texture.width, texture.height);
    const glm::dvec2 at = uv * size - 0.5, corner = glm::floor(at), f = at - corner;
    const double texels = uvError.x * size.x + uvError.y * size.y;
    if (!(texels < 1.0) || !(std::max(std::abs(at.x), std::abs(at.y)) < 1e15)) return {0.5, 1.0};
    const auto x = static_cast<int64_t>(corner.x), y = static_cast<int64_t>(corner.y);
    double lowest = 1.0, highest = 0.0;
    for (int64_t dy = -1; dy <= 2; ++dy)
        for (int64_t dx = -1; dx <= 2; ++dx) {
            const double alpha = alphaTexel(texture, x + dx, y + dy);
            lowest = std::min(lowest, alpha);
            highest = std::max(highest, alpha);
        }
    const double upper = std::lerp(alphaTexel(texture, x, y), alphaTexel(texture, x + 1, y), f.x);
    const double lower = std::lerp(alphaTexel(texture, x, y + 1), alphaTexel(texture, x + 1, y + 1), f.x);
    return {std::lerp(upper, lower, f.y), texels * (highest - lowest)};
}

Alpha alphaOf(const Scene& scene, const Mesh& mesh, const Material& material, const Candidate& hit) {
    const double factor = static_cast<double>(material.alpha);
    if (material.baseColorTexture == kNoTexture) return {factor, 0.0};
    if (!mesh.quadrics.empty()) return {0.5, 1.0};
    glm::dvec2 uv(0.0), error(0.0);
    if (!mesh.uvs.empty()) {
        const glm::uvec3 t = mesh.triangles[hit.primitive];
        const glm::dvec2 uv0(mesh.uvs[t.x]), byU = glm::dvec2(mesh.uvs[t.y]) - uv0,
                                             byV = glm::dvec2(mesh.uvs[t.z]) - uv0;
        uv = uv0 + hit.barycentrics.x * byU + hit.barycentrics.y * byV;
        error = hit.barycentricError.x * glm::abs(byU) + hit.barycentricError.y * glm::abs(byV) +
                kUvRoundings * kRounding * (glm::abs(uv0) + glm::abs(byU) + glm::abs(byV));
    }
    const Texture& texture = scene.textures[static_cast<size_t>(material.baseColorTexture)];
    const Alpha alpha = sample(texture, uv, error);
    return {factor * alpha.value, factor * (alpha.error + kAlphaRoundings * kRounding)};
}

}  // namespace

void applyAlpha(const Scene& scene, const Placement& placement, uint32_t key, Candidate& candidate) {
    const Material& material = scene.materials[placement.mesh->material];
    if (material.alphaMode == AlphaMode::opaque) return;
    const Alpha alpha = alphaOf(scene, *placement.mesh, material, candidate);
    const bool blends = material.alphaMode == AlphaMode::blend;
    const double cutoff = blends ? blendCutoff(key, candidate) : static_cast<double>(material.alphaCutoff);
    const bool accepted = blends ? cutoff < alpha.value : alpha.value >= cutoff;
    candidate.exact = candidate.exact && accepted;
    const bool sure = alpha.error == 0.0 || std::abs(alpha.value - cutoff) > alpha.error;
    if (sure && accepted) return;
    candidate.covers = false;
    if (sure)
        candidate.certainty = Certainty::none;
    else if (candidate.certainty == Certainty::certain)
        candidate.certainty = Certainty::possible;
}

}  // namespace raylab::oracle
