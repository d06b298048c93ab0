#include "ui/editor/compare_view.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "engine/image/srgb.h"
#include "engine/measure/image_pair.h"
#include "ui/editor/compare.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

constexpr float kSquare = 64.0f;       ///< of the checker, in ImGui's units
constexpr double kBlinkSeconds = 0.6;  ///< of each side
constexpr float kGrab = 6.0f;          ///< to each side of the line
constexpr uint32_t kScaleTexels = 64;

/// Images of a comparison on the window's device.
struct CompareImages {
    UiImagePtr b, difference, scale;
    uint64_t shownB = 0;
    uint64_t shownA = 0, shownDifferenceB = 0;  ///< pictures that `difference` is of
    CompareMode shownMode = CompareMode::off;
    bool dragsLine = false;
};

Comparison& comparisonOf(EditorContext& context) { return context.states.get<Comparison>(); }

/// Where B's picture is when both are shown whole.
ViewRectangle besideOf(const ViewRectangle& view) { return {view.x + view.width, view.y, view.width, view.height}; }

void update(EditorContext& context, CompareImages& images) {
    const Comparison& comparison = comparisonOf(context);
    const auto& b = comparison.side(true).picture;
    if (b && images.shownB != b->number) {
        context.images.setTexels(images.b, b->texels, b->width, b->height);
        images.shownB = b->number;
    }
    const CompareResult& result = comparison.result();
    const bool isNew =
        images.shownA != result.numberA || images.shownDifferenceB != result.numberB || images.shownMode != result.mode;
    if (!isNew || result.texels.empty()) return;
    context.images.setTexels(images.difference, result.texels, result.width, result.height);
    images.shownA = result.numberA;
    images.shownDifferenceB = result.numberB;
    images.shownMode = result.mode;
}

/// The part from (u0, v0) to (u1, v1) of an image that fills the rectangle.
void drawPart(EditorContext& context, const UiImagePtr& image, const ViewRectangle& r, float u0, float v0, float u1,
              float v1) {
    context.images.draw(*ImGui::GetWindowDrawList(), image, {r.x + u0 * r.width, r.y + v0 * r.height},
                        {r.x + u1 * r.width, r.y + v1 * r.height}, {u0, v0}, {u1, v1});
}

void drawWhole(EditorContext& context, const UiImagePtr& image, const ViewRectangle& r) {
    drawPart(context, image, r, 0.0f, 0.0f, 1.0f, 1.0f);
}

void drawChecker(EditorContext& context, const UiImagePtr& a, const UiImagePtr& b) {
    const ViewRectangle& r = context.view;
    const float square = kSquare * context.scale, du = square / r.width, dv = square / r.height;
    drawWhole(context, a, r);
    const int columns = static_cast<int>(std::ceil(1.0f / du)), rows = static_cast<int>(std::ceil(1.0f / dv));
    for (int y = 0; y < rows; ++y)
        for (int x = 1 - y % 2; x < columns; x += 2) {
            const float u = static_cast<float>(x) * du, v = static_cast<float>(y) * dv;
            drawPart(context, b, r, u, v, std::min(u + du, 1.0f), std::min(v + dv, 1.0f));
        }
}

bool blinksToB() { return static_cast<int64_t>(std::floor(ImGui::GetTime() / kBlinkSeconds)) % 2 == 1; }

/// A text on a dark ground; (x, y) is its upper left, or its upper right where `fromRight`.
void drawLabel(const std::string& text, float x, float y, bool fromRight, const ImVec4& color) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str()), pad = {7.0f, 3.0f};
    const float left = fromRight ? x - size.x - 2.0f * pad.x : x;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({left, y}, {left + size.x + 2.0f * pad.x, y + size.y + 2.0f * pad.y},
                       ImGui::GetColorU32(ImVec4(0.06f, 0.062f, 0.068f, 0.78f)), 3.0f);
    list.AddText({left + pad.x, y + pad.y}, ImGui::GetColorU32(color), text.c_str());
}

/// What B has that A has not: "B  depth 3, sampler sobol".
std::string labelOfB(const EditorContext& context, const Comparison& comparison) {
    constexpr int kMost = 3;
    std::string text;
    int count = 0;
    for (const Setting<RenderSettings>& row : renderSettingsTable()) {
        const SettingValue b = getSetting(row, comparison.settings());
        if (Comparison::isShared(row.name) || b == getSetting(row, context.state.settings())) continue;
        if (++count > kMost) continue;
        text += (text.empty() ? "" : ", ") + std::string(row.name) + " " + settingText(b);
    }
    if (count > kMost) text += ", ...";
    return "B  " + (text.empty() ? "as A" : text);
}

void drawLabels(const EditorContext& context, const Comparison& comparison) {
    const ViewRectangle& r = context.view;
    const float gap = 8.0f * context.scale;
    const CompareMode mode = comparison.mode();
    const std::string b = labelOfB(context, comparison);
    const bool both = mode == CompareMode::wipe || mode == CompareMode::checker || mode == CompareMode::sideBySide;
    const ViewRectangle second = mode == CompareMode::sideBySide ? besideOf(r) : r;
    if (both) {
        drawLabel("A", r.x + gap, r.y + gap, false, color::kText);
        drawLabel(b, second.x + second.width - gap, r.y + gap, true, color::kAccent);
    } else if (mode == CompareMode::blink) {
        const bool isB = blinksToB();
        drawLabel(isB ? b : "A", r.x + gap, r.y + gap, false, isB ? color::kAccent : color::kText);
    } else {
        const CompareResult& result = comparison.result();
        const bool isOld = result.mode != mode;
        const std::string name(infoOf(mode).name);
        const std::string& text = isOld ? name : result.mismatch.empty() ? result.figure : result.mismatch;
        drawLabel("A against " + b + "   " + text, r.x + gap, r.y + gap, false, color::kText);
    }
}

std::string scaleText(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", value);
    return text.data();
}

/// The colours of a difference and what they stand for.
void drawScale(EditorContext& context, CompareImages& images) {
    if (images.scale == nullptr) {
        Bitmap ramp(kScaleTexels, 1, 1);
        for (uint32_t i = 0; i < kScaleTexels; ++i) ramp.pixels[i] = static_cast<float>(i) / (kScaleTexels - 1);
        const Bitmap heat = heatPicture(ramp, 0.0, 1.0);
        std::vector<uint32_t> texels;
        for (uint32_t i = 0; i < kScaleTexels; ++i) {
            const float* p = heat.pixels.data() + 3 * size_t{i};
            texels.push_back(uint32_t{linearToSrgb8(p[0])} | uint32_t{linearToSrgb8(p[1])} << 8 |
                             uint32_t{linearToSrgb8(p[2])} << 16 | 0xff000000u);
        }
        context.images.setTexels(images.scale, texels, kScaleTexels, 1);
    }
    const ViewRectangle& r = context.view;
    const HeatScale scale = heatScaleOf(comparisonOf(context).mode());
    const float gap = 8.0f * context.scale, width = 160.0f * context.scale, height = 8.0f * context.scale;
    const float x = r.x + gap, y = r.y + r.height - gap - height;
    const float textY = y - gap - ImGui::GetTextLineHeight();
    drawLabel(scaleText(scale.low), x, textY, false, color::kText);
    drawLabel(scaleText(scale.high) + (scale.isLogarithmic ? "  log" : ""), x + width, textY, true, color::kText);
    context.images.draw(*ImGui::GetWindowDrawList(), images.scale, {x, y}, {x + width, y + height}, {0.0f, 0.0f},
                        {1.0f, 1.0f});
}

void drawDifference(EditorContext& context, CompareImages& images, const UiImagePtr& imageA) {
    const CompareMode mode = comparisonOf(context).mode();
    const bool isThere = images.difference != nullptr && images.shownMode == mode;
    drawWhole(context, isThere ? images.difference : imageA, context.view);
    if (isThere && mode != CompareMode::firstHit) drawScale(context, images);
}

}  // namespace

void drawComparison(EditorContext& context, const UiImagePtr& imageA) {
    Comparison& comparison = comparisonOf(context);
    auto& images = context.states.get<CompareImages>();
    update(context, images);
    const ViewRectangle& r = context.view;
    const UiImagePtr& b = images.b != nullptr ? images.b : imageA;
    switch (comparison.mode()) {
        case CompareMode::wipe:
            drawPart(context, imageA, r, 0.0f, 0.0f, comparison.wipe, 1.0f);
            drawPart(context, b, r, comparison.wipe, 0.0f, 1.0f, 1.0f);
            break;
        case CompareMode::checker:
            drawChecker(context, imageA, b);
            break;
        case CompareMode::blink:
            drawWhole(context, blinksToB() ? b : imageA, r);
            context.redrawSeconds = std::min(context.redrawSeconds, 0.1);
            break;
        case CompareMode::sideBySide:
            drawWhole(context, imageA, r);
            drawWhole(context, b, besideOf(r));
            break;
        default:
            drawDifference(context, images, imageA);
    }
}

bool drawComparisonHandles(EditorContext& context) {
    Comparison& comparison = comparisonOf(context);
    if (!comparison.isOn()) return false;
    drawLabels(context, comparison);
    auto& images = context.states.get<CompareImages>();
    if (comparison.mode() != CompareMode::wipe) return false;
    const ViewRectangle& r = context.view;
    const ImGuiIO& io = ImGui::GetIO();
    const float x = r.x + comparison.wipe * r.width;
    const bool isNear = ImGui::IsItemHovered() && std::abs(io.MousePos.x - x) < kGrab * context.scale;
    if (isNear && ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !io.KeyAlt) images.dragsLine = true;
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) images.dragsLine = false;
    if (images.dragsLine) comparison.wipe = std::clamp((io.MousePos.x - r.x) / r.width, 0.0f, 1.0f);
    const bool isHeld = images.dragsLine || isNear;
    if (isHeld) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    const float at = r.x + comparison.wipe * r.width;
    ImGui::GetWindowDrawList()->AddLine({at, r.y}, {at, r.y + r.height},
                                        ImGui::GetColorU32(isHeld ? color::kAccent : ImVec4(1.0f, 1.0f, 1.0f, 0.7f)),
                                        (isHeld ? 2.0f : 1.0f) * context.scale);
    return isHeld;
}

}  // namespace raylab
