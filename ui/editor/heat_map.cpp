#include "ui/editor/heat_map.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/editor/model/edit_kinds.h"
#include "ui/editor/panel_parts.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

using editor::packColor;

constexpr double kRestSeconds = 0.3;  ///< without a movement, until counting starts
constexpr uint32_t kBins = 64;
constexpr uint32_t kOutside = 0xff3a3634u;  ///< a pixel without a ray: a dark grey

CountWish wishOf(const EditorContext& context, const HeatState& heat) {
    return {context.state.document->rendered(),
            context.state.settings(),
            context.state.camera,
            std::max(context.viewWidth / heat.divisor, 1u),
            std::max(context.viewHeight / heat.divisor, 1u),
            heat.bounces};
}

bool sameWish(const CountWish& a, const CountWish& b) {
    using namespace editor;
    if (!(a.camera == b.camera) || a.width != b.width || a.height != b.height || a.bounces != b.bounces) return false;
    if ((editKinds(a.settings, b.settings) & (kEditGeometry | kEditTrees | kEditKernel)) != 0) return false;
    return a.scene == b.scene ||
           (editKinds(*a.scene, *b.scene) & (kEditGeometry | kEditTransforms | kEditMaterials)) == 0;
}

void spreadValues(HeatState& heat) {
    const BounceCounts& bounce = heat.shown->bounces[heat.bounce];
    const CountField& field = kCountFields[heat.field];
    heat.values.assign(size_t{heat.shown->width} * heat.shown->height, kNoCount);
    heat.summary = summarise(bounce, field);
    heat.binSize = heat.summary.most / kBins + 1;
    heat.histogram.assign(heat.summary.most / heat.binSize + 1, 0);
    uint32_t least = heat.summary.most;
    for (size_t i = 0; i < bounce.counts.size(); ++i) {
        const uint32_t value = bounce.counts[i].*field.member;
        heat.values[bounce.pixels[i]] = value;
        ++heat.histogram[value / heat.binSize];
        least = std::min(least, value);
    }
    if (heat.autoRange) {
        heat.lo = least;
        heat.hi = std::max(heat.summary.high, least + 1);
    }
}

/// Numbers of what is shown, where that is something else.
void keepValues(HeatState& heat) {
    heat.bounce = std::min(heat.bounce, heat.counter.counts()->bounces.size() - 1);
    const bool isSame =
        heat.shown == heat.counter.counts() && heat.shownField == heat.field && heat.shownBounce == heat.bounce;
    if (isSame) return;
    heat.shown = heat.counter.counts();
    heat.shownField = heat.field;
    heat.shownBounce = heat.bounce;
    heat.imageMap.reset();
    spreadValues(heat);
}

void keepImage(EditorContext& context, HeatState& heat) {
    if (heat.imageMap == heat.map && heat.imageLo == heat.lo && heat.imageHi == heat.hi) return;
    std::array<uint32_t, 256> colors;
    for (size_t i = 0; i < colors.size(); ++i)
        colors[i] = packColor(mapColor(heat.map, static_cast<double>(i) / (colors.size() - 1)));
    const float scale = 255.0f / static_cast<float>(std::max(heat.hi - std::min(heat.lo, heat.hi), 1u));
    std::vector<uint32_t> texels;
    texels.reserve(heat.values.size());
    for (const uint32_t value : heat.values) {
        const float part = value > heat.lo ? scale * static_cast<float>(value - heat.lo) : 0.0f;
        texels.push_back(value == kNoCount ? kOutside : colors[static_cast<size_t>(std::min(part, 255.0f))]);
    }
    context.images.setTexels(heat.image, texels, heat.shown->width, heat.shown->height);
    heat.imageMap = heat.map;
    heat.imageLo = heat.lo;
    heat.imageHi = heat.hi;
}

/// Count under the pointer; nothing where it is elsewhere or there is no ray.
std::optional<uint32_t> countUnderPointer(const EditorContext& context, const HeatState& heat) {
    const ImVec2 at = ImGui::GetIO().MousePos;
    const ViewRectangle& r = context.view;
    const float x = (at.x - r.x) / r.width, y = (at.y - r.y) / r.height;
    if (!(x >= 0.0f && x < 1.0f && y >= 0.0f && y < 1.0f)) return {};
    const auto column = static_cast<uint32_t>(x * static_cast<float>(heat.shown->width));
    const auto row = static_cast<uint32_t>(y * static_cast<float>(heat.shown->height));
    const uint32_t value = heat.values[size_t{row} * heat.shown->width + column];
    return value == kNoCount ? std::nullopt : std::optional(value);
}

void drawScale(const EditorContext& context, const HeatState& heat) {
    const float s = context.scale, line = ImGui::GetTextLineHeight(), width = 210.0f * s, pad = 8.0f * s;
    const ImVec2 lo(context.view.x + pad, context.view.y + context.view.height - 2.0f * line - 3.5f * pad);
    const ImVec2 hi(lo.x + width + 2.0f * pad, context.view.y + context.view.height - pad);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(lo, hi, IM_COL32(20, 20, 24, 215), 3.0f * s);
    std::string title = std::string(kCountFields[heat.field].title) +
                        (heat.bounce == 0 ? ", primary rays" : ", bounce " + std::to_string(heat.bounce));
    if (const auto here = countUnderPointer(context, heat)) title += ": " + std::to_string(*here);
    list.AddText({lo.x + pad, lo.y + 0.5f * pad}, ImGui::GetColorU32(color::kText), title.c_str());
    const std::string low = countText(heat.lo), high = countText(heat.hi);
    const float y = lo.y + line + pad;
    list.AddText({lo.x + pad, y}, ImGui::GetColorU32(color::kDim), low.c_str());
    const float highX = hi.x - pad - ImGui::CalcTextSize(high.c_str()).x;
    list.AddText({highX, y}, ImGui::GetColorU32(color::kDim), high.c_str());
    const float from = lo.x + pad + ImGui::CalcTextSize(low.c_str()).x + pad, to = highX - pad;
    constexpr int kSteps = 40;
    for (int i = 0; i < kSteps; ++i) {
        const float x0 = from + (to - from) * static_cast<float>(i) / kSteps,
                    x1 = from + (to - from) * static_cast<float>(i + 1) / kSteps;
        list.AddRectFilled({x0, y + 0.25f * line}, {x1, y + 0.8f * line},
                           packColor(mapColor(heat.map, (i + 0.5) / kSteps)));
    }
}

/// A map of another view would lie.
bool isOfThisView(const EditorContext& context, const HeatState& heat) {
    return heat.shown != nullptr && heat.shown->camera == context.state.camera;
}

}  // namespace

void keepHeatMap(EditorContext& context) {
    auto& heat = context.states.get<HeatState>();
    heat.counter.collect();
    if (!heat.show || !context.state.hasScene() || context.viewWidth == 0) return;
    if (heat.lastCamera != context.state.camera || context.viewMoves) heat.sinceChange.restart();
    heat.lastCamera = context.state.camera;
    const CountWish wish = wishOf(context, heat);
    const bool isNew = !heat.counter.wish() || !sameWish(*heat.counter.wish(), wish);
    if (isNew && heat.sinceChange.seconds() >= kRestSeconds) heat.counter.start(wish);
    if (heat.counter.counts() == nullptr) return;
    keepValues(heat);
    keepImage(context, heat);
}

void drawHeatMap(EditorContext& context) {
    const auto& heat = context.states.get<HeatState>();
    if (!heat.show || !isOfThisView(context, heat)) return;
    const ViewRectangle& r = context.view;
    context.images.draw(*ImGui::GetWindowDrawList(), heat.image, {r.x, r.y}, {r.x + r.width, r.y + r.height},
                        {0.0f, 0.0f}, {1.0f, 1.0f}, true);
}

void drawHeatScale(EditorContext& context) {
    const auto& heat = context.states.get<HeatState>();
    if (heat.show && isOfThisView(context, heat)) drawScale(context, heat);
}

}  // namespace raylab
