#include "ui/editor/texture_thumbnails.h"

#include <array>
#include <map>
#include <vector>

namespace raylab {
namespace {

constexpr uint32_t kSide = 64;
constexpr size_t kMostThumbnails = 256;

/// What tells textures apart whose memory may be used again.
using Key = std::array<uintptr_t, 4>;

Key keyOf(const Texture& t) {
    return {reinterpret_cast<uintptr_t>(t.texels.data()), t.width, t.height,
            t.texels.empty() ? 0 : t.texels[t.texels.size() / 2]};
}

/// Means of a grid of 4 x 4 texels for each of its own: enough for a picture of this size.
std::vector<uint32_t> shrunk(const Texture& t) {
    std::vector<uint32_t> texels(kSide * kSide);
    constexpr uint32_t kTaps = 4;
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) {
            std::array<uint32_t, 3> sum{};
            for (uint32_t tap = 0; tap < kTaps * kTaps; ++tap) {
                const uint64_t u = (x * kTaps + tap % kTaps) * uint64_t{t.width} / (kSide * kTaps);
                const uint64_t v = (y * kTaps + tap / kTaps) * uint64_t{t.height} / (kSide * kTaps);
                const uint32_t texel = t.texels[v * t.width + u];
                for (uint32_t c = 0; c < 3; ++c) sum[c] += texel >> (8 * c) & 0xFF;
            }
            constexpr uint32_t kCount = kTaps * kTaps;
            texels[y * kSide + x] = 0xFF000000u | sum[0] / kCount | sum[1] / kCount << 8 | sum[2] / kCount << 16;
        }
    return texels;
}

struct Thumbnails {
    std::map<Key, UiImagePtr> images;
};

const UiImagePtr& imageOf(EditorContext& context, const Texture& texture) {
    auto& images = context.states.get<Thumbnails>().images;
    const Key key = keyOf(texture);
    if (const auto found = images.find(key); found != images.end()) return found->second;
    if (images.size() >= kMostThumbnails) images.clear();
    UiImagePtr& image = images[key];
    context.images.setTexels(image, shrunk(texture), kSide, kSide);
    return image;
}

}  // namespace

void drawThumbnailAt(EditorContext& context, const Texture& texture, const ImVec2& at, float side) {
    if (texture.texels.empty()) return;
    context.images.draw(*ImGui::GetWindowDrawList(), imageOf(context, texture), {at.x + 1.0f, at.y + 1.0f},
                        {at.x + side - 1.0f, at.y + side - 1.0f}, {0.0f, 0.0f}, {1.0f, 1.0f});
}

void drawThumbnail(EditorContext& context, const Texture& texture, float side) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy({side, side});
    drawThumbnailAt(context, texture, at, side);
}

}  // namespace raylab
