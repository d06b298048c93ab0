#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

struct ImVec2;

namespace raylab {

/// One point of a curve; both values positive, or it is left out.
struct PlotPoint {
    double x = 0.0;
    double y = 0.0;
    double low = std::numeric_limits<double>::quiet_NaN();  ///< ends of the band; NaN: none here
    double high = std::numeric_limits<double>::quiet_NaN();
    bool ringed = false;
};

enum class PlotLine { solid, dotted, none };

/// A curve. Colours are ImGui's, R in the lowest byte.
struct PlotSeries {
    std::string name;  ///< for the legend; empty: not in it
    uint32_t color = 0xffffffffu;
    std::vector<PlotPoint> points;  ///< by rising x
    PlotLine line = PlotLine::solid;
    bool hasMarkers = true;  ///< a series without them is not pointed at
    bool isDim = false;      ///< another one is being looked at
};

/// A line across the plot at one value of y, with its text at the right end.
struct PlotLevel {
    double y = 0.0;
    std::string text;
    uint32_t color = 0xffffffffu;
};

/// A chart with two logarithmic axes.
struct PlotSpec {
    const char* id = "plot";  ///< ImGui's, of the window's own
    std::string xLabel;
    std::string yLabel;
    std::string (*showX)(double value) = nullptr;  ///< nullptr: three digits
    std::string (*showY)(double value) = nullptr;
    std::vector<PlotSeries> series;
    std::vector<PlotLevel> levels;
    bool hasLegend = true;
    std::string empty = "no points yet";  ///< said where there is nothing to draw
};

/// A point of a series, by their numbers.
struct PlotPick {
    size_t series = 0;
    size_t point = 0;

    bool operator==(const PlotPick&) const = default;
};

/// What the pointer does in the plot.
struct PlotResult {
    std::optional<PlotPick> hovered;  ///< the point that is nearest to the pointer, if near enough
    bool clicked = false;             ///< on the hovered point, or beside all
    /// Where the points are on the screen, by series; NaN for those that are left out.
    std::vector<std::vector<std::pair<float, float>>> places;
};

/// Draws into the current window, at the cursor, as an item of `size` (ImGui's units). The axes hold all points, bands
/// and levels.
PlotResult drawPlot(const PlotSpec& spec, const ImVec2& size);

}  // namespace raylab
