#include "ui/editor/outline.h"

#include <imgui.h>

#include <algorithm>

#include "ui/editor/theme.h"

namespace raylab {
namespace {

constexpr int kRadius = 2;  ///< pixels, of a picture of full size

struct OutlineState {
    UiImagePtr image;
    std::shared_ptr<const HitMap> shown;
    std::vector<bool> selected;
};

/// By the rendered scene's instances.
std::vector<bool> selectedInstances(const editor::Document& document) {
    const std::vector<uint32_t>& chosen = document.selection().instances;
    std::vector<bool> selected(document.rendered()->instances.size());
    for (uint32_t i = 0; i < selected.size(); ++i)
        selected[i] = std::ranges::find(chosen, document.sceneInstance(i)) != chosen.end();
    return selected;
}

}  // namespace

std::vector<uint32_t> outlineTexels(const HitMap& map, const std::vector<bool>& selected, int radius, uint32_t color) {
    const auto width = static_cast<int>(map.width), height = static_cast<int>(map.height);
    std::vector<uint8_t> inside(map.hits.size());
    for (size_t i = 0; i < inside.size(); ++i) {
        const uint32_t instance = map.hits[i].instance;
        inside[i] = instance < selected.size() && selected[instance] ? 1 : 0;
    }
    std::vector<uint32_t> texels(inside.size(), color & 0x00ffffffu);
    const auto mark = [&](int x, int y) {
        for (int j = std::max(y - radius, 0); j <= std::min(y + radius, height - 1); ++j)
            for (int i = std::max(x - radius, 0); i <= std::min(x + radius, width - 1); ++i) {
                const size_t at = static_cast<size_t>(j) * map.width + static_cast<size_t>(i);
                const int square = (i - x) * (i - x) + (j - y) * (j - y);
                if (inside[at] == 0 && square <= radius * radius + 1) texels[at] = color;
            }
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t at = static_cast<size_t>(y) * map.width + static_cast<size_t>(x);
            if (inside[at] == 0) continue;
            const bool isEdge = (x > 0 && inside[at - 1] == 0) || (x + 1 < width && inside[at + 1] == 0) ||
                                (y > 0 && inside[at - map.width] == 0) ||
                                (y + 1 < height && inside[at + map.width] == 0);
            if (isEdge) mark(x, y);
        }
    return texels;
}

bool drawOutline(EditorContext& context) {
    if (context.picture == nullptr || context.picture->hits == nullptr) return false;
    const HitMap& map = *context.picture->hits;
    auto& state = context.states.get<OutlineState>();
    std::vector<bool> selected = selectedInstances(*context.state.document);
    if (state.shown != context.picture->hits || state.selected != selected) {
        state.shown = context.picture->hits;
        state.selected = std::move(selected);
        const int radius = context.viewWidth >= 2 * map.width ? 1 : kRadius;
        context.images.setTexels(state.image,
                                 outlineTexels(map, state.selected, radius, ImGui::GetColorU32(color::kSelection)),
                                 map.width, map.height);
    }
    const ViewRectangle& r = context.view;
    context.images.draw(*ImGui::GetWindowDrawList(), state.image, {r.x, r.y}, {r.x + r.width, r.y + r.height},
                        {0.0f, 0.0f}, {1.0f, 1.0f});
    return true;
}

}  // namespace raylab
