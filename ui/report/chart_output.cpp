#include "ui/report/chart_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "engine/core/file.h"
#include "engine/core/log.h"
#include "ui/report/chart_report.h"
#include "ui/report/chart_svg.h"
#include "ui/report/gnuplot.h"
#include "ui/report/settings_file.h"

namespace raylab {
namespace {

std::string formatted(const char* format, double value) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

nlohmann::ordered_json numberJson(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json intervalJson(const Interval& interval) {
    return {
        {"value", numberJson(interval.value)}, {"low", numberJson(interval.low)}, {"high", numberJson(interval.high)}};
}

nlohmann::ordered_json fitJson(const std::optional<LineFit>& fit) {
    if (!fit) return nullptr;
    nlohmann::ordered_json json = intervalJson(fit->slopeInterval());
    json["standardError"] = numberJson(fit->slopeError);
    return json;
}

nlohmann::ordered_json groupJson(const ChartGroup& group) {
    nlohmann::ordered_json json{{"samples", group.samples},
                                {"seeds", group.seeds},
                                {"deviceSeconds", intervalJson(group.deviceSeconds)},
                                {"wallSeconds", intervalJson(group.wallSeconds)},
                                {"error", intervalJson(group.error)},
                                {"medianError", group.medianError},
                                {"pareto", group.pareto},
                                {"paretoPossible", group.paretoPossible}};
    if (group.bias)
        json["bias"] = {{"biasSquared", numberJson(group.bias->biasSquared)},
                        {"standardError", numberJson(group.bias->standardError)},
                        {"variance", numberJson(group.bias->variance)}};
    return json;
}

nlohmann::ordered_json curveJson(const Chart& chart, size_t i) {
    const ChartCurve& curve = chart.curves[i];
    nlohmann::ordered_json groups = nlohmann::ordered_json::array();
    for (const ChartGroup& group : curve.groups) groups.push_back(groupJson(group));
    const Reference& reference = *chart.references[i];
    nlohmann::ordered_json json{{"config", curve.config},
                                {"settings", settingsJson(chart.plan.configs[i].settings)},
                                {"command", chart.renderCommand(i)},
                                {"reference", {{"from", reference.origin}, {"relativeError", reference.relativeError}}},
                                {"slope", fitJson(curve.fit)},
                                {"tailSlope", fitJson(curve.tail)},
                                {"plateau", nameOf(curve.plateau)},
                                {"bias", intervalJson(curve.bias)},
                                {"groups", groups}};
    if (i < chart.setupTimes.size() && chart.setupTimes[i])
        json["setupSeconds"] = {{"build", chart.setupTimes[i]->build},
                                {"upload", chart.setupTimes[i]->upload},
                                {"compile", chart.setupTimes[i]->compile}};
    return json;
}

nlohmann::ordered_json rowsJson(const std::vector<ChartTableRow>& rows, const Chart& chart, const char* key) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const ChartTableRow& row : rows) {
        nlohmann::ordered_json figures = nlohmann::ordered_json::object();
        for (size_t i = 0; i < row.figures.size(); ++i)
            if (row.figures[i]) figures[chart.curves[i].config] = intervalJson(*row.figures[i]);
        list.push_back({{key, row.at}, {"figures", figures}});
        if (row.best) list.back()["best"] = chart.curves[row.best->curve].config;
    }
    return list;
}

nlohmann::ordered_json pointsJson(const Chart& chart) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const ChartPoint& p : chart.table.points) {
        const auto config = std::ranges::find(chart.plan.configs, p.config, &ChartConfig::name);
        const auto index = static_cast<size_t>(config - chart.plan.configs.begin());
        list.push_back({{"config", p.config},
                        {"seed", p.seed},
                        {"samples", p.samples},
                        {"deviceSeconds", p.deviceSeconds},
                        {"wallSeconds", p.wallSeconds},
                        {"rmse", numberJson(p.rmse)},
                        {"relMse", numberJson(p.relMse)},
                        {"flip", numberJson(p.flip)},
                        {"command", chart.renderCommand(index) + " --seed " + std::to_string(p.seed) + " --spp " +
                                        std::to_string(p.samples) + " -o point.exr"}});
    }
    return list;
}

ChartTableRow makeRow(const Chart& chart, double at,
                      std::optional<Interval> (*figureOf)(const ChartCurve& curve, double at)) {
    ChartTableRow row{at, {}, std::nullopt};
    for (const ChartCurve& curve : chart.curves) row.figures.push_back(figureOf(curve, at));
    row.best = bestOf(row.figures);
    return row;
}

size_t countFigures(const ChartTableRow& row) {
    return static_cast<size_t>(std::ranges::count_if(row.figures, [](const auto& f) { return f.has_value(); }));
}

/// The row that compares most curves; of several the one further on, `last`, or the first.
const ChartTableRow* mostTelling(const std::vector<ChartTableRow>& rows, bool last) {
    const ChartTableRow* best = nullptr;
    for (const ChartTableRow& row : rows) {
        if (!row.best) continue;
        const size_t count = countFigures(row);
        if (best == nullptr || count > countFigures(*best) || (last && count == countFigures(*best))) best = &row;
    }
    return best;
}

std::string tiesText(const Chart& chart, const ChartBest& best) {
    if (best.ties.empty()) return {};
    std::string text = "; within its interval: ";
    for (size_t i = 0; i < best.ties.size(); ++i) text += (i == 0 ? "" : ", ") + chart.curves[best.ties[i]].config;
    return text;
}

std::string secondsRange(const Interval& interval) {
    return secondsText(interval.value) + " (" + secondsText(interval.low) + " to " +
           (std::isfinite(interval.high) ? secondsText(interval.high) : "more than was measured") + ")";
}

std::string errorRange(const Interval& interval) {
    return shortNumber(interval.value) + " (" + shortNumber(interval.low) + " to " + shortNumber(interval.high) + ")";
}

}  // namespace

std::string shortNumber(double value) { return formatted("%.3g", value); }

std::string secondsText(double seconds) {
    if (seconds < 1e-3) return formatted("%.3g", seconds * 1e6) + " us";
    return seconds < 1.0 ? formatted("%.3g", seconds * 1e3) + " ms" : formatted("%.3g", seconds) + " s";
}

std::string plateauText(const ChartCurve& curve) {
    switch (curve.plateau) {
        case Plateau::none:
            return {};
        case Plateau::bias:
            return "bias " + errorRange(curve.bias);
        case Plateau::referenceNoise:
            return "flat: what is left is the reference's noise";
        case Plateau::unexplained:
            return "flat, and chance may be the reason: more samples or seeds would tell";
    }
    return {};
}

ChartTables makeTables(const Chart& chart) {
    ChartTables tables;
    std::vector<double> errors = tableErrors(chart.curves);
    if (chart.targetError > 0.0) errors.push_back(chart.targetError);
    std::ranges::sort(errors);
    errors.erase(std::unique(errors.begin(), errors.end()), errors.end());
    for (const double error : errors) tables.equalError.push_back(makeRow(chart, error, timeToError));
    for (const double seconds : tableTimes(chart.curves))
        tables.equalTime.push_back(makeRow(chart, seconds, errorAtTime));
    return tables;
}

std::string chartAnswer(const Chart& chart, const ChartTables& tables) {
    const ChartTableRow* error = mostTelling(tables.equalError, false);
    for (const ChartTableRow& row : tables.equalError)
        if (row.at == chart.targetError) error = &row;
    const ChartTableRow* time = mostTelling(tables.equalTime, true);
    std::string text;
    if (error != nullptr && error->best)
        text = "For an error of " + shortNumber(error->at) + " the cheapest is " +
               chart.curves[error->best->curve].config + ", in " + secondsRange(error->best->value) +
               tiesText(chart, *error->best) + ".";
    else if (error != nullptr)
        text = "No configuration was measured to fall to an error of " + shortNumber(error->at) + ".";
    if (time != nullptr)
        text += (text.empty() ? "For " : " For ") + secondsText(time->at) + " the most accurate is " +
                chart.curves[time->best->curve].config + ", with an error of " + errorRange(time->best->value) +
                tiesText(chart, *time->best) + ".";
    return text.empty() ? "Too few points to answer." : text;
}

void writeChartJson(const Chart& chart) {
    nlohmann::ordered_json curves = nlohmann::ordered_json::array();
    for (size_t i = 0; i < chart.curves.size(); ++i) curves.push_back(curveJson(chart, i));
    const ChartTables tables = makeTables(chart);
    const nlohmann::ordered_json json{{"schema", "raylab.chart/1"},
                                      {"version", RAYLAB_VERSION},
                                      {"scene", chart.scene},
                                      {"device", chart.device},
                                      {"error", nameOf(chart.plan.measure)},
                                      {"confidence", kConfidence},
                                      {"interrupted", chart.isInterrupted},
                                      {"deviceLoss", chart.deviceLoss},
                                      {"answer", chartAnswer(chart, tables)},
                                      {"curves", curves},
                                      {"equalError", rowsJson(tables.equalError, chart, "error")},
                                      {"equalTime", rowsJson(tables.equalTime, chart, "deviceSeconds")},
                                      {"points", pointsJson(chart)},
                                      {"identity", chartIdentity(chart)}};
    writeJson(chart.jsonFile().string(), json);
}

void writeChartOutput(const Chart& chart) {
    const auto write = [&](const char* name, const std::string& text) {
        writeFileAtomically(chart.folder / name, std::as_bytes(std::span(text)));
    };
    writeChartJson(chart);
    write("chart.svg", chartSvg(chart.curves, {chartTitle(chart), chartSubtitle(chart), errorAxisLabel(chart)}));
    write("report.html", chartReport(chart, makeTables(chart)));
    write("chart.gnuplot", chartGnuplot(chart));
    const bool hasPoints = std::ranges::any_of(chart.curves, [](const ChartCurve& c) { return !c.groups.empty(); });
    if (hasPoints && !runGnuplot(chart.folder / "chart.gnuplot"))
        logWarning("gnuplot is not installed: chart.png is missing; once it is, gnuplot chart.gnuplot draws it");
}

void writeChart(const Chart& chart) {
    writePartials(chart);
    writeChartCsv(chart);
    writeChartOutput(chart);
}

void printChart(const Chart& chart) {
    const ChartTables tables = makeTables(chart);
    for (const ChartCurve& curve : chart.curves) {
        std::cout << curve.config << "\n";
        if (curve.fit)
            std::cout << "  slope " << formatted("%.3f", curve.fit->slope) << " +- "
                      << formatted("%.3f", curve.fit->slopeError) << "\n";
        for (const ChartGroup& group : curve.groups)
            std::cout << formatted("  %8.0f samples  ", group.samples) << secondsText(group.deviceSeconds.value)
                      << "  error " << errorRange(group.error) << (group.pareto ? "  *" : "") << "\n";
        if (const std::string plateau = plateauText(curve); !plateau.empty()) std::cout << "  " << plateau << "\n";
    }
    std::cout << chartAnswer(chart, tables) << "\n";
}

}  // namespace raylab
