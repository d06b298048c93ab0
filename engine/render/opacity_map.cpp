#include "engine/render/opacity_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "shaders/shared/scene.h"

namespace raylab {
namespace {

constexpr int kRows = 4;               ///< of microtriangles
constexpr double kSlackTexels = 0.02;  ///< around a microtriangle, for the rounding of texture coordinates
constexpr float kSlackAlpha = 1e-4f;   ///< around the cutoff, for the rounding of interpolated alpha
constexpr double kMostRows = 1 << 14;  ///< of texels that a microtriangle may cover; beyond, it stays unknown

using Corners = std::array<glm::dvec2, 3>;

int wrapTexel(int64_t x, int size, Wrap mode) {
    if (mode == Wrap::clamp) return static_cast<int>(std::clamp<int64_t>(x, 0, size - 1));
    const int64_t period = mode == Wrap::mirror ? int64_t{2} * size : size;
    const int64_t m = ((x % period) + period) % period;
    return static_cast<int>(m < size ? m : period - 1 - m);
}

uint32_t classify(const Material& material, float lowest, float highest) {
    if (material.alphaMode == AlphaMode::blend) {
        if (lowest >= 1.0f) return shared::kOpacityOpaque;
        return highest <= 0.0f ? shared::kOpacityTransparent : shared::kOpacityUnknown;
    }
    if (lowest >= material.alphaCutoff + kSlackAlpha) return shared::kOpacityOpaque;
    return highest < material.alphaCutoff - kSlackAlpha ? shared::kOpacityTransparent : shared::kOpacityUnknown;
}

/// The range of x that a triangle covers between two heights; empty (first > second) where it does not reach there.
std::pair<double, double> rangeBetween(const Corners& corners, double lo, double hi) {
    std::pair<double, double> range{1e300, -1e300};
    const auto add = [&](double x) {
        range.first = std::min(range.first, x);
        range.second = std::max(range.second, x);
    };
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec2 a = corners[i], b = corners[(i + 1) % 3];
        if (a.y >= lo && a.y <= hi) add(a.x);
        for (const double y : {lo, hi})
            if ((a.y < y) != (b.y < y)) add(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    }
    return range;
}

/// Sums along the rows of a texture, to tell in one step what a stretch of a row holds.
class RowSums {
public:
    RowSums(const Material& material, const Texture& texture)
        : texture_(texture), sums_(size_t{texture.height} * stride()) {
        std::array<uint32_t, 256> classes;
        for (uint32_t a = 0; a < 256; ++a) {
            const float alpha = material.alpha * static_cast<float>(a) / 255.0f;
            classes[a] = classify(material, alpha, alpha);
        }
        tbb::parallel_for(uint32_t{0}, texture.height, [&](uint32_t y) {
            Sum* row = &sums_[y * stride()];
            for (uint32_t x = 0; x < texture.width; ++x) {
                const uint32_t opacity = classes[texture.texels[size_t{y} * texture.width + x] >> 24];
                row[x + 1] = row[x];
                row[x + 1].opaque += opacity == shared::kOpacityOpaque ? 1 : 0;
                row[x + 1].transparent += opacity == shared::kOpacityTransparent ? 1 : 0;
            }
        });
    }

    /// What the texels first .. last of row y have in common, by the texture's wrap modes.
    uint32_t opacity(int64_t first, int64_t last, int64_t y) const {
        const Sum* row =
            &sums_[static_cast<size_t>(wrapTexel(y, static_cast<int>(texture_.height), texture_.wrapV)) * stride()];
        const int64_t width = texture_.width;
        if (last - first + 1 >= width) return common(row, 0, width - 1);
        const int64_t a = wrapTexel(first, static_cast<int>(width), texture_.wrapU);
        const int64_t b = wrapTexel(last, static_cast<int>(width), texture_.wrapU);
        if (texture_.wrapU != Wrap::repeat) return commonOfFolded(row, first, last, a, b);
        if (a <= b) return common(row, a, b);
        const uint32_t left = common(row, 0, b);
        return left == common(row, a, width - 1) ? left : shared::kOpacityUnknown;
    }

private:
    struct Sum {
        uint32_t opaque = 0;
        uint32_t transparent = 0;
    };

    size_t stride() const { return size_t{texture_.width} + 1; }

    static uint32_t common(const Sum* row, int64_t first, int64_t last) {
        const auto count = static_cast<uint32_t>(last - first + 1);
        if (row[last + 1].opaque - row[first].opaque == count) return shared::kOpacityOpaque;
        return row[last + 1].transparent - row[first].transparent == count ? shared::kOpacityTransparent
                                                                           : shared::kOpacityUnknown;
    }

    /// Clamped or mirrored: a stretch shorter than the row that runs over an end of it folds back onto itself.
    uint32_t commonOfFolded(const Sum* row, int64_t first, int64_t last, int64_t a, int64_t b) const {
        const int64_t width = texture_.width;
        const auto tileOf = [&](int64_t x) { return x >= 0 ? x / width : -((width - 1 - x) / width); };
        if (tileOf(first) == tileOf(last)) return common(row, std::min(a, b), std::max(a, b));
        if (texture_.wrapU == Wrap::clamp) return common(row, std::min(a, b), std::max(a, b));
        return (tileOf(first) & 1) == 0 ? common(row, std::min(a, b), width - 1) : common(row, 0, std::max(a, b));
    }

    const Texture& texture_;
    std::vector<Sum> sums_;
};

/// Opacity over all points of a triangle given in texels, texel centres at whole numbers.
uint32_t opacityOver(const RowSums& sums, const Corners& corners) {
    const auto [yLo, yHi] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const auto [xLo, xHi] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    if (!(yHi - yLo < kMostRows) || !(std::max({-xLo, xHi, -yLo, yHi}) < 1e9)) return shared::kOpacityUnknown;
    uint32_t opacity = shared::kOpacityUnknown;
    const auto end = static_cast<int64_t>(std::floor(yHi + kSlackTexels));
    for (auto y = static_cast<int64_t>(std::floor(yLo - kSlackTexels)); y <= end; ++y) {
        const auto row = static_cast<double>(y);
        const auto [first, last] = rangeBetween(corners, row - kSlackTexels, row + 1.0 + kSlackTexels);
        if (first > last) continue;
        const auto from = static_cast<int64_t>(std::floor(first - kSlackTexels));
        const auto to = static_cast<int64_t>(std::floor(last + kSlackTexels)) + 1;
        const uint32_t here = sums.opacity(from, to, y);
        if (opacity == shared::kOpacityUnknown) opacity = here;
        if (here == shared::kOpacityUnknown || here != opacity || here != sums.opacity(from, to, y + 1))
            return shared::kOpacityUnknown;
    }
    return opacity;
}

/// Corners of microtriangle (row, column) in barycentrics of the second and third vertex.
std::array<glm::dvec2, 3> microCorners(int row, int column, bool turned) {
    const glm::dvec2 at(row, column);
    const glm::dvec2 a = turned ? at + 1.0 : at;
    return {a / double{kRows}, (at + glm::dvec2(1.0, 0.0)) / double{kRows},
            (at + glm::dvec2(0.0, 1.0)) / double{kRows}};
}

/// `uvs`: of the three vertices, in texels.
uint32_t opacityOfTriangle(const RowSums& sums, const Corners& uvs) {
    uint32_t map = 0;
    uint32_t index = 0;
    for (int row = 0; row < kRows; ++row)
        for (int i = 0; i < 2 * (kRows - row) - 1; ++i, ++index) {
            Corners corners = microCorners(row, i / 2, i % 2 == 1);
            for (glm::dvec2& corner : corners)
                corner = uvs[0] + corner.x * (uvs[1] - uvs[0]) + corner.y * (uvs[2] - uvs[0]);
            map |= opacityOver(sums, corners) << (2 * index);
        }
    return map;
}

}  // namespace

std::vector<uint32_t> opacityMaps(const Scene& scene, const Mesh& mesh) {
    const Material& material = scene.materials[mesh.material];
    if (material.alphaMode == AlphaMode::opaque)
        return std::vector<uint32_t>(mesh.triangles.size(), shared::kAllOpaque);
    if (material.baseColorTexture == kNoTexture || mesh.uvs.empty()) {
        const bool plain = material.baseColorTexture == kNoTexture;
        const uint32_t opacity = plain ? classify(material, material.alpha, material.alpha) : shared::kOpacityUnknown;
        return std::vector<uint32_t>(mesh.triangles.size(), opacity * 0x55555555u);
    }
    const Texture& texture = scene.textures[static_cast<size_t>(material.baseColorTexture)];
    const glm::dvec2 size(texture.width, texture.height);
    const RowSums sums(material, texture);
    std::vector<uint32_t> maps(mesh.triangles.size());
    tbb::parallel_for(size_t{0}, maps.size(), [&](size_t i) {
        const auto texel = [&](uint32_t vertex) { return glm::dvec2(mesh.uvs[vertex]) * size - 0.5; };
        const glm::uvec3 t = mesh.triangles[i];
        maps[i] = opacityOfTriangle(sums, {texel(t.x), texel(t.y), texel(t.z)});
    });
    return maps;
}

}  // namespace raylab
