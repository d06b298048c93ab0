#include "ui/report/chart_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "engine/core/file.h"
#include "ui/report/chart_svg.h"

namespace raylab {
namespace {

constexpr const char* kPageStyle = R"(<style>
:root { color-scheme: light dark; --ink: #1c1e21; --soft: #5d636b; --line: #d9dde2; --paper: #ffffff; --best: #e4f1ea; --card: #f5f6f8; }
@media (prefers-color-scheme: dark) { :root { --ink: #e8eaed; --soft: #a2a9b3; --line: #3c4149; --paper: #17191d; --best: #1f3a2d; --card: #202329; } }
body { margin: 2rem auto; max-width: 62rem; padding: 0 1.2rem; color: var(--ink); background: var(--paper);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", "Liberation Sans", sans-serif; }
h1 { font-size: 1.5rem; margin: 0; } h2 { font-size: 1.1rem; margin: 2.2rem 0 .5rem; } p { margin: .4rem 0; }
.soft { color: var(--soft); } .answer { font-size: 1.1rem; background: var(--card); padding: .9rem 1.1rem; border-radius: .5rem; margin: 1.2rem 0; }
.wide { overflow-x: auto; } svg.chart { max-width: 100%; height: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; } th, td { padding: .3rem .8rem; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th:first-child, td:first-child { text-align: left; } td.best { background: var(--best); font-weight: 600; } td .soft { font-weight: 400; font-size: .85em; display: block; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(13rem, 1fr)); gap: 1rem; } figure { margin: 0; }
figure img { width: 100%; display: block; image-rendering: pixelated; border-radius: .25rem; } figure img + img { margin-top: .25rem; } figcaption { font-size: .9rem; padding-top: .3rem; }
.key { display: inline-block; width: .8em; height: .8em; border-radius: .2em; margin-right: .4em; }
.ramp { display: inline-block; width: 9rem; height: .7rem; vertical-align: middle; border-radius: .2rem; border: 1px solid var(--line); }
pre { background: var(--card); padding: .7rem 1rem; border-radius: .5rem; overflow-x: auto; font-size: .85rem; }
</style>
)";

std::string base64(const std::vector<std::byte>& bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = 0;
        for (size_t j = 0; j < 3; ++j)
            word = word << 8 | (i + j < bytes.size() ? std::to_integer<uint32_t>(bytes[i + j]) : 0u);
        for (size_t j = 0; j < 4; ++j) text += i + j > bytes.size() ? '=' : kDigits[word >> (18 - 6 * j) & 63u];
    }
    return text;
}

/// An image as a data URI; nothing where the file is gone.
std::string imageElement(const std::filesystem::path& file, const std::string& what) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code)) return {};
    return "<img alt=\"" + xmlEscaped(what) + "\" src=\"data:image/png;base64," + base64(readFile(file)) + "\">\n";
}

std::string keyOf(size_t curve) {
    return "<span class=\"key\" style=\"background:" + std::string(curveColor(curve)) + "\"></span>";
}

std::string figureCell(const std::optional<Interval>& figure, bool isBest, std::string (*show)(double)) {
    if (!figure) return "<td>&ndash;</td>";
    const std::string high = std::isfinite(figure->high) ? show(figure->high) : "&infin;";
    return std::string(isBest ? "<td class=\"best\">" : "<td>") + show(figure->value) + "<span class=\"soft\">" +
           show(figure->low) + " &ndash; " + high + "</span></td>";
}

std::string tableOf(const Chart& chart, const std::vector<ChartTableRow>& rows, const std::string& corner,
                    std::string (*showAt)(double), std::string (*show)(double)) {
    std::string html = "<div class=\"wide\"><table>\n<tr><th>" + corner + "</th>";
    for (const ChartTableRow& row : rows) html += "<th>" + showAt(row.at) + "</th>";
    html += "</tr>\n";
    for (size_t i = 0; i < chart.curves.size(); ++i) {
        html += "<tr><td>" + keyOf(i) + xmlEscaped(chart.curves[i].config) + "</td>";
        for (const ChartTableRow& row : rows)
            html += figureCell(row.figures[i], row.best && row.best->curve == i, show);
        html += "</tr>\n";
    }
    return html + "</table></div>\n";
}

/// The group that is nearest to a time from below; the first where none is.
const ChartGroup& groupAt(const ChartCurve& curve, double seconds) {
    const ChartGroup* chosen = &curve.groups.front();
    for (const ChartGroup& group : curve.groups)
        if (group.deviceSeconds.value <= seconds * 1.05) chosen = &group;
    return *chosen;
}

std::string picturesOf(const Chart& chart) {
    double seconds = 0.0;
    for (const ChartCurve& curve : chart.curves)
        if (!curve.groups.empty()) {
            const double last = curve.groups.back().deviceSeconds.value;
            seconds = seconds == 0.0 ? last : std::min(seconds, last);
        }
    std::string html = "<h2>At equal time: " + secondsText(seconds) +
                       "</h2>\n<p class=\"soft\">The most samples within that time; below, " +
                       "the squared relative error of each pixel: <span class=\"ramp\" "
                       "style=\"background:linear-gradient(90deg,#000,#3b0f6f,"
                       "#8c2981,#de4968,#fe9f6d,#fff)\"></span> 0.0001 to 100</p>\n<div class=\"pictures\">\n";
    for (size_t i = 0; i < chart.curves.size(); ++i) {
        const ChartCurve& curve = chart.curves[i];
        if (curve.groups.empty()) continue;
        const ChartGroup& group = groupAt(curve, seconds);
        html += "<figure>" + imageElement(chart.pictureFile(i, group.samples), curve.config) +
                imageElement(chart.heatFile(i, group.samples), "error of " + curve.config) + "<figcaption>" + keyOf(i) +
                xmlEscaped(curve.config) + "<br><span class=\"soft\">" + std::to_string(group.samples) + " samples, " +
                secondsText(group.deviceSeconds.value) + ", error " + shortNumber(group.error.value) +
                "</span></figcaption></figure>\n";
    }
    return html + "</div>\n";
}

std::string plusMinus(double value, double error) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.3f &plusmn; %.3f", value, error);
    return text.data();
}

std::string curvesTable(const Chart& chart) {
    std::string html =
        "<div class=\"wide\"><table>\n<tr><th>configuration</th><th>samples</th><th>slope</th><th>slope of the "
        "tail</th>"
        "<th>bias</th><th>build, upload, compile</th><th>plateau</th></tr>\n";
    for (size_t i = 0; i < chart.curves.size(); ++i) {
        const ChartCurve& curve = chart.curves[i];
        const auto slope = [](const std::optional<LineFit>& fit) {
            return fit && fit->degrees > 0 ? plusMinus(fit->slope, fit->slopeError) : std::string("&ndash;");
        };
        const bool isCut = i < chart.levelLimits.size() && chart.levelLimits[i] < chart.plan.levels;
        const std::string samples =
            (curve.groups.empty() ? "&ndash;" : "1 &ndash; " + std::to_string(curve.groups.back().samples)) +
            (isCut ? "<span class=\"soft\">time limit</span>" : "");
        const std::string bias = std::isnan(curve.bias.value)
                                     ? "&ndash;"
                                     : shortNumber(curve.bias.value) + "<span class=\"soft\">" +
                                           shortNumber(curve.bias.low) + " &ndash; " + shortNumber(curve.bias.high) +
                                           "</span>";
        std::string setup = "&ndash;";
        if (i < chart.setupTimes.size() && chart.setupTimes[i]) {
            const RenderTimes& t = *chart.setupTimes[i];
            setup = secondsText(t.build + t.upload + t.compile);
        }
        html += "<tr><td>" + keyOf(i) + xmlEscaped(curve.config) + "</td><td>" + samples + "</td><td>" +
                slope(curve.fit) + "</td><td>" + slope(curve.tail) + "</td><td>" + bias + "</td><td>" + setup +
                "</td><td>" + xmlEscaped(plateauText(curve)) + "</td></tr>\n";
    }
    return html + "</table></div>\n";
}

std::string commandsOf(const Chart& chart) {
    std::string html = "<pre>";
    for (size_t i = 0; i < chart.plan.configs.size(); ++i)
        html += "# " + xmlEscaped(chart.plan.configs[i].name) + "\n" + xmlEscaped(chart.renderCommand(i)) +
                " --seed SEED --spp SAMPLES -o point.exr\n";
    return html + "</pre>\n";
}

std::string methodText(const Chart& chart) {
    const Reference& reference = *chart.references.front();
    return "<p>Each point is one rendering with random numbers of its own; " + std::to_string(chart.plan.seeds) +
           " for each number of samples, measured in turn over all configurations. Times are of the device, without "
           "build, upload and "
           "compilation. Errors are geometric means with Student's 95&nbsp;% interval of their logarithms; times are "
           "medians. Figures "
           "between points are interpolated in logarithms, never beyond them. Bias is what the images of all seeds "
           "together are off "
           "the reference, free of their noise and the reference's; its interval is of "
           "99.8&nbsp;%.</p>\n<p>Reference: " +
           xmlEscaped(reference.origin) + ", relative error " + shortNumber(reference.relativeError) +
           (reference.image.parts == 0 ? " (taken for exact)" : "") + ".</p>\n";
}

}  // namespace

std::string chartTitle(const Chart& chart) {
    return std::filesystem::path(chart.scene).stem().string() + ": error against time";
}

std::string chartSubtitle(const Chart& chart) {
    const RenderSettings& settings = chart.plan.configs.front().settings;
    return std::to_string(settings.width) + " \u00d7 " + std::to_string(settings.height) + " on " + chart.device +
           ", " + std::to_string(chart.plan.seeds) + " seeds, bands of 95 %";
}

std::string errorAxisLabel(const Chart& chart) {
    if (chart.plan.measure == ErrorMeasure::relative) return "relative error, sqrt(relMSE)";
    return chart.plan.measure == ErrorMeasure::rmse ? "RMSE, radiance" : "mean FLIP";
}

std::string chartReport(const Chart& chart, const ChartTables& tables) {
    std::string html =
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<title>" +
        xmlEscaped(chartTitle(chart)) + "</title>\n" + kPageStyle + "</head><body>\n";
    html += "<h1>" + xmlEscaped(chartTitle(chart)) + "</h1>\n<p class=\"soft\">" + xmlEscaped(chartSubtitle(chart)) +
            "</p>\n";
    html += "<p class=\"answer\">" + xmlEscaped(chartAnswer(chart, tables)) + "</p>\n";
    if (chart.isInterrupted) html += "<p>Interrupted" + (chart.deviceLoss.empty() ? "" : ", " + xmlEscaped(chart.deviceLoss)) +
                ": the same command resumes it.</p>\n";
    html += chartSvg(chart.curves, {chartTitle(chart), chartSubtitle(chart), errorAxisLabel(chart)});
    html += picturesOf(chart);
    html += "<h2>Time to equal error</h2>\n" + tableOf(chart, tables.equalError, "error", shortNumber, secondsText);
    html += "<h2>Error at equal time</h2>\n" + tableOf(chart, tables.equalTime, "time", secondsText, shortNumber);
    html +=
        "<h2>Slopes and biases</h2>\n<p class=\"soft\">Of error over samples in logarithms, &plusmn; a standard error; "
        "noise alone has "
        "&minus;0.5.</p>\n" +
        curvesTable(chart);
    html +=
        "<h2>Commands</h2>\n<p class=\"soft\">Seeds and samples of each point are in chart.csv, whole commands in "
        "chart.json.</p>\n" +
        commandsOf(chart);
    return html + "<h2>Method</h2>\n" + methodText(chart) + "</body></html>\n";
}

}  // namespace raylab
