#include "ui/editor/plot.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "engine/measure/log_axis.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

constexpr float kReach = 18.0f;  ///< from the pointer to the point that it means, at a font of 14 pixels
constexpr float kBandAlpha = 0.16f;
constexpr float kDimAlpha = 0.30f;

ImU32 withAlpha(ImU32 color, float alpha) {
    ImVec4 value = ImGui::ColorConvertU32ToFloat4(color);
    value.w *= alpha;
    return ImGui::ColorConvertFloat4ToU32(value);
}

bool isShown(const PlotPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0.0 && p.y > 0.0; }

double endOr(double end, double value) { return std::isfinite(end) && end > 0.0 ? end : value; }

std::string shown(std::string (*show)(double), double value) {
    if (show != nullptr) return show(value);
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

/// Where values are on the screen.
struct Frame {
    LogAxis x, y;
    ImVec2 lo, hi;  ///< upper left and lower right corner of the area of the curves
    float unit = 1.0f;

    float atX(double value) const { return lo.x + static_cast<float>(x.partOf(value)) * (hi.x - lo.x); }
    float atY(double value) const { return hi.y - static_cast<float>(y.partOf(value)) * (hi.y - lo.y); }
    ImVec2 at(double vx, double vy) const { return {atX(vx), atY(vy)}; }
};

Frame frameOf(const PlotSpec& spec, const ImVec2& corner, const ImVec2& size) {
    std::vector<double> xs, ys;
    for (const PlotSeries& series : spec.series)
        for (const PlotPoint& p : series.points) {
            if (!isShown(p)) continue;
            xs.push_back(p.x);
            ys.insert(ys.end(), {p.y, p.low, p.high});
        }
    for (const PlotLevel& level : spec.levels) ys.push_back(level.y);
    Frame frame{logAxisAround(xs), logAxisAround(ys), {}, {}, ImGui::GetFontSize() / 14.0f};
    float widest = 0.0f;
    for (const LogTick& tick : logTicks(frame.y))
        if (tick.isLabelled) widest = std::max(widest, ImGui::CalcTextSize(shown(spec.showY, tick.value).c_str()).x);
    const float line = ImGui::GetTextLineHeight();
    frame.lo = {corner.x + widest + 8.0f * frame.unit, corner.y + line + 5.0f * frame.unit};
    frame.hi = {corner.x + size.x - 8.0f * frame.unit, corner.y + size.y - 2.0f * line - 7.0f * frame.unit};
    return frame;
}

struct Painter {
    ImDrawList& list;
    const PlotSpec& spec;
    const Frame& frame;

    void axes() const;
    void band(const PlotSeries& series) const;
    void curve(const PlotSeries& series, size_t index) const;
    void levels() const;
    void legend() const;
    void hovered(const PlotPick& pick) const;

private:
    void gridX(ImU32 strong, ImU32 weak, ImU32 text) const;
    void gridY(ImU32 strong, ImU32 weak, ImU32 text) const;
    void dots(const ImVec2& from, const ImVec2& to, ImU32 color) const;
    void marker(size_t index, const ImVec2& at, ImU32 color, float radius) const;
};

/// Labels that would touch the one before are left out.
void Painter::gridX(ImU32 strong, ImU32 weak, ImU32 text) const {
    float free = frame.lo.x - 20.0f * frame.unit;
    for (const LogTick& tick : logTicks(frame.x)) {
        const float x = frame.atX(tick.value);
        list.AddLine({x, frame.lo.y}, {x, frame.hi.y}, tick.isLabelled ? strong : weak);
        if (!tick.isLabelled) continue;
        const std::string label = shown(spec.showX, tick.value);
        const float half = 0.5f * ImGui::CalcTextSize(label.c_str()).x;
        if (x - half < free || x + half > frame.hi.x + 8.0f * frame.unit) continue;
        list.AddText({x - half, frame.hi.y + 3.0f * frame.unit}, text, label.c_str());
        free = x + half + 8.0f * frame.unit;
    }
}

void Painter::gridY(ImU32 strong, ImU32 weak, ImU32 text) const {
    const float line = ImGui::GetTextLineHeight();
    float free = frame.hi.y + line;
    for (const LogTick& tick : logTicks(frame.y)) {
        const float y = frame.atY(tick.value);
        list.AddLine({frame.lo.x, y}, {frame.hi.x, y}, tick.isLabelled ? strong : weak);
        if (!tick.isLabelled || y + 0.5f * line > free) continue;
        const std::string label = shown(spec.showY, tick.value);
        const float width = ImGui::CalcTextSize(label.c_str()).x;
        list.AddText({frame.lo.x - width - 5.0f * frame.unit, y - 0.5f * line}, text, label.c_str());
        free = y - 0.5f * line;
    }
}

void Painter::axes() const {
    const ImU32 strong = ImGui::GetColorU32(ImVec4(1.0f, 1.0f, 1.0f, 0.11f));
    const ImU32 weak = ImGui::GetColorU32(ImVec4(1.0f, 1.0f, 1.0f, 0.04f));
    const ImU32 dim = ImGui::GetColorU32(color::kDim);
    gridX(strong, weak, dim);
    gridY(strong, weak, dim);
    list.AddRect(frame.lo, frame.hi, ImGui::GetColorU32(ImVec4(1.0f, 1.0f, 1.0f, 0.22f)));
    const float line = ImGui::GetTextLineHeight();
    list.AddText({frame.lo.x, frame.lo.y - line - 3.0f * frame.unit}, dim, spec.yLabel.c_str());
    const float width = ImGui::CalcTextSize(spec.xLabel.c_str()).x;
    list.AddText({frame.hi.x - width, frame.hi.y + line + 4.0f * frame.unit}, dim, spec.xLabel.c_str());
}

/// Without antialiasing, which would draw a seam between neighbouring quadrilaterals.
void Painter::band(const PlotSeries& series) const {
    const ImU32 fill = withAlpha(series.color, series.isDim ? kBandAlpha * kDimAlpha : kBandAlpha);
    const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
    const PlotPoint* before = nullptr;
    for (const PlotPoint& p : series.points) {
        if (!isShown(p)) continue;
        if (before != nullptr && (std::isfinite(before->high) || std::isfinite(p.high))) {
            list.PrimReserve(6, 4);
            list.PrimQuadUV(frame.at(before->x, endOr(before->high, before->y)), frame.at(p.x, endOr(p.high, p.y)),
                            frame.at(p.x, endOr(p.low, p.y)), frame.at(before->x, endOr(before->low, before->y)), white,
                            white, white, white, fill);
        }
        before = &p;
    }
}

void Painter::dots(const ImVec2& from, const ImVec2& to, ImU32 color) const {
    const float step = 5.0f * frame.unit;
    const float length = std::hypot(to.x - from.x, to.y - from.y);
    for (float way = 0.0f; way < length; way += step) {
        const float part = way / length;
        list.AddCircleFilled({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)}, 1.1f * frame.unit,
                             color, 6);
    }
}

/// Circles, squares, triangles and diamonds in turn, as in the chart's SVG.
void Painter::marker(size_t index, const ImVec2& at, ImU32 color, float radius) const {
    const float r = radius * frame.unit;
    switch (index % 4) {
        case 0:
            return list.AddCircleFilled(at, r, color);
        case 1:
            return list.AddRectFilled({at.x - 0.9f * r, at.y - 0.9f * r}, {at.x + 0.9f * r, at.y + 0.9f * r}, color);
        case 2:
            return list.AddTriangleFilled({at.x, at.y - 1.2f * r}, {at.x + 1.15f * r, at.y + 0.8f * r},
                                          {at.x - 1.15f * r, at.y + 0.8f * r}, color);
        default:
            return list.AddQuadFilled({at.x, at.y - 1.25f * r}, {at.x + 1.25f * r, at.y}, {at.x, at.y + 1.25f * r},
                                      {at.x - 1.25f * r, at.y}, color);
    }
}

void Painter::curve(const PlotSeries& series, size_t index) const {
    const ImU32 color = series.isDim ? withAlpha(series.color, kDimAlpha) : series.color;
    const PlotPoint* before = nullptr;
    for (const PlotPoint& p : series.points) {
        if (!isShown(p)) continue;
        const ImVec2 here = frame.at(p.x, p.y);
        if (before != nullptr && series.line == PlotLine::solid)
            list.AddLine(frame.at(before->x, before->y), here, color, 1.7f * frame.unit);
        else if (before != nullptr && series.line == PlotLine::dotted)
            dots(frame.at(before->x, before->y), here, color);
        before = &p;
    }
    for (const PlotPoint& p : series.points) {
        if (!isShown(p)) continue;
        if (series.hasMarkers) marker(index, frame.at(p.x, p.y), color, 3.4f);
        if (p.ringed)
            list.AddCircle(frame.at(p.x, p.y), 6.5f * frame.unit, ImGui::GetColorU32(color::kText), 0, frame.unit);
    }
}

void Painter::levels() const {
    const float line = ImGui::GetTextLineHeight();
    for (const PlotLevel& level : spec.levels) {
        if (!(level.y > 0.0)) continue;
        const float y = frame.atY(level.y);
        list.AddLine({frame.lo.x, y}, {frame.hi.x, y}, level.color, 1.2f * frame.unit);
        const float width = ImGui::CalcTextSize(level.text.c_str()).x;
        const bool fitsAbove = y - line - 2.0f * frame.unit > frame.lo.y;
        list.AddText({frame.hi.x - width - 5.0f * frame.unit, fitsAbove ? y - line - frame.unit : y + frame.unit},
                     level.color, level.text.c_str());
    }
}

void Painter::legend() const {
    float widest = 0.0f, rows = 0.0f;
    for (const PlotSeries& series : spec.series) {
        if (series.name.empty()) continue;
        widest = std::max(widest, ImGui::CalcTextSize(series.name.c_str()).x);
        rows += 1.0f;
    }
    if (!spec.hasLegend || rows == 0.0f) return;
    const float pad = 6.0f * frame.unit, key = 20.0f * frame.unit, line = ImGui::GetTextLineHeightWithSpacing();
    const ImVec2 hi{frame.hi.x - pad, frame.lo.y + 2.0f * pad + rows * line};
    const ImVec2 lo{hi.x - widest - key - 3.0f * pad, frame.lo.y + pad};
    list.AddRectFilled(lo, hi, ImGui::GetColorU32(ImGuiCol_PopupBg, 0.85f), 3.0f * frame.unit);
    float y = lo.y + 0.5f * pad;
    for (size_t i = 0; i < spec.series.size(); ++i) {
        const PlotSeries& series = spec.series[i];
        if (series.name.empty()) continue;
        const ImVec2 from{lo.x + pad, y + 0.5f * line}, to{lo.x + pad + key, y + 0.5f * line};
        if (series.line == PlotLine::solid) list.AddLine(from, to, series.color, 1.7f * frame.unit);
        if (series.line == PlotLine::dotted) dots(from, to, series.color);
        if (series.hasMarkers) marker(i, {0.5f * (from.x + to.x), from.y}, series.color, 3.4f);
        list.AddText({to.x + pad, y + 0.5f * (line - ImGui::GetTextLineHeight())}, ImGui::GetColorU32(color::kText),
                     series.name.c_str());
        y += line;
    }
}

/// Lines to both axes, and a ring in the curve's colour.
void Painter::hovered(const PlotPick& pick) const {
    const PlotSeries& series = spec.series[pick.series];
    const ImVec2 at = frame.at(series.points[pick.point].x, series.points[pick.point].y);
    const ImU32 color = withAlpha(series.color, 0.55f);
    list.AddLine(at, {at.x, frame.hi.y}, color, frame.unit);
    list.AddLine(at, {frame.lo.x, at.y}, color, frame.unit);
    marker(pick.series, at, series.color, 4.8f);
    list.AddCircle(at, 8.5f * frame.unit, series.color, 0, 1.6f * frame.unit);
}

std::optional<PlotPick> nearestPoint(const PlotSpec& spec, const Frame& frame) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    std::optional<PlotPick> nearest;
    float least = kReach * frame.unit;
    for (size_t s = 0; s < spec.series.size(); ++s) {
        if (!spec.series[s].hasMarkers) continue;
        for (size_t i = 0; i < spec.series[s].points.size(); ++i) {
            const PlotPoint& p = spec.series[s].points[i];
            if (!isShown(p)) continue;
            const ImVec2 at = frame.at(p.x, p.y);
            const float distance = std::hypot(at.x - mouse.x, at.y - mouse.y);
            if (distance >= least) continue;
            least = distance;
            nearest = PlotPick{s, i};
        }
    }
    return nearest;
}

std::vector<std::vector<std::pair<float, float>>> placesOf(const PlotSpec& spec, const Frame& frame) {
    std::vector<std::vector<std::pair<float, float>>> places;
    for (const PlotSeries& series : spec.series) {
        places.emplace_back();
        for (const PlotPoint& p : series.points) {
            const ImVec2 at = isShown(p) ? frame.at(p.x, p.y) : ImVec2(NAN, NAN);
            places.back().emplace_back(at.x, at.y);
        }
    }
    return places;
}

bool hasPoints(const PlotSpec& spec) {
    return std::ranges::any_of(spec.series, [](const PlotSeries& s) { return std::ranges::any_of(s.points, isShown); });
}

}  // namespace

PlotResult drawPlot(const PlotSpec& spec, const ImVec2& size) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(spec.id, {std::max(size.x, 1.0f), std::max(size.y, 1.0f)});
    const Frame frame = frameOf(spec, corner, size);
    if (frame.hi.x - frame.lo.x < 20.0f || frame.hi.y - frame.lo.y < 20.0f) return {};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Painter painter{list, spec, frame};
    PlotResult result;
    if (!hasPoints(spec)) {
        list.AddRect(frame.lo, frame.hi, ImGui::GetColorU32(ImVec4(1.0f, 1.0f, 1.0f, 0.12f)));
        const ImVec2 text = ImGui::CalcTextSize(spec.empty.c_str());
        list.AddText({0.5f * (frame.lo.x + frame.hi.x - text.x), 0.5f * (frame.lo.y + frame.hi.y - text.y)},
                     ImGui::GetColorU32(color::kDim), spec.empty.c_str());
        return result;
    }
    painter.axes();
    list.PushClipRect(frame.lo, {frame.hi.x + frame.unit, frame.hi.y + frame.unit}, true);
    for (const PlotSeries& series : spec.series) painter.band(series);
    painter.levels();
    for (size_t i = 0; i < spec.series.size(); ++i) painter.curve(spec.series[i], i);
    if (ImGui::IsItemHovered()) {
        result.hovered = nearestPoint(spec, frame);
        result.clicked = ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    }
    if (result.hovered) painter.hovered(*result.hovered);
    painter.legend();
    list.PopClipRect();
    result.places = placesOf(spec, frame);
    return result;
}

}  // namespace raylab
