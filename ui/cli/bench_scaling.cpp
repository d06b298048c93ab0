#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "engine/core/file.h"
#include "engine/measure/scaling.h"
#include "engine/render/device_defaults.h"
#include "engine/scene/bounds.h"
#include "ui/cli/bench_output.h"
#include "ui/report/gnuplot.h"

namespace raylab {
namespace {

constexpr size_t kFewest = 1000;
constexpr std::array kScalingKinds = {"primary", "diffuse"};

struct ScalingPoint {
    size_t triangles = 0;
    BenchRow row;

    double nsPerRay() const { return 1e3 / row.mraysPerSecond; }
    double nsLow() const { return 1e3 / row.high; }
    double nsHigh() const { return 1e3 / row.low; }
    double nodesPerRay() const { return row.counters->nodes; }
};

/// How the cost of a kind of rays grows.
struct ScalingFit {
    std::string rayKind;
    LogarithmicFit ns;
    LogarithmicFit nodes;
};

std::vector<ScalingPoint> measurePoints(BenchRun& run, const BenchOptions& options) {
    const BenchPlan plan{.base = run.settings,
                         .variants = {{run.settings, ""}},
                         .kinds = {kScalingKinds.begin(), kScalingKinds.end()},
                         .light = options.light,
                         .repeats = options.repeats};
    std::vector<ScalingPoint> points;
    measureKeepingRows(options, run, [&] {
        for (size_t wanted = kFewest; wanted <= static_cast<size_t>(options.largest); wanted *= 10) {
            const Scene scene = makeCave(wanted);
            measureScene(run, scene.name, scene, plan, options.json != "-");
            for (const BenchRow& row : run.scenes.back().rows) points.push_back({triangleCount(scene).stored, row});
        }
    });
    return points;
}

std::vector<ScalingFit> fitPoints(const std::vector<ScalingPoint>& points) {
    std::vector<ScalingFit> fits;
    for (const char* kind : kScalingKinds) {
        std::vector<double> triangles, ns, nodes;
        for (const ScalingPoint& point : points) {
            if (point.row.rayKind != kind) continue;
            triangles.push_back(static_cast<double>(point.triangles));
            ns.push_back(point.nsPerRay());
            nodes.push_back(point.nodesPerRay());
        }
        fits.push_back({kind, fitLogarithm(triangles, ns), fitLogarithm(triangles, nodes)});
    }
    return fits;
}

void writeText(const std::filesystem::path& path, const std::string& text) {
    writeFileAtomically(path, std::as_bytes(std::span(text)));
}

void writeScalingCsv(const std::filesystem::path& path, const std::vector<ScalingPoint>& points) {
    std::ostringstream text;
    text << "rayKind,triangles,nsPerRay,nsLow,nsHigh,nodesPerRay,trianglesPerRay\n";
    for (const ScalingPoint& point : points)
        text << point.row.rayKind << ',' << point.triangles << ',' << point.nsPerRay() << ',' << point.nsLow() << ','
             << point.nsHigh() << ',' << point.nodesPerRay() << ',' << point.row.counters->triangles << '\n';
    writeText(path, text.str());
}

std::string scalingScript(const std::filesystem::path& csv, const BenchRun& run, const std::vector<ScalingFit>& fits) {
    std::ostringstream text;
    text << "set terminal svg size 800,500 dynamic background rgb 'white'\n"
         << "set output " << gnuplotQuoted(csv.stem().string() + ".svg") << "\n"
         << "set datafile separator ','\nset logscale x\nset format x '10^{%L}'\nset key top left\n"
         << "set xlabel 'triangles'\nset ylabel 'ns per ray'\nset yrange [0:*]\n"
         << "set title "
         << gnuplotQuoted("cost of a ray, " + run.settings.layout + ", " + run.device.description().name)
         << " noenhanced\nplot ";
    const char* separator = "";
    int color = 1;
    for (const ScalingFit& fit : fits) {
        text << separator << gnuplotQuoted(csv.filename().string()) << " using (strcol(1) eq '" << fit.rayKind
             << "' ? $2 : NaN):3:4:5 with yerrorbars pointtype 7 linecolor " << color << " title '" << fit.rayKind
             << "', " << fit.ns.constant << " + " << fit.ns.perDoubling << " * log(x) / log(2) linecolor " << color
             << std::setprecision(3) << " title '" << fit.ns.constant << " + " << fit.ns.perDoubling
             << " log_2 n, R^2 = " << fit.ns.rSquared << std::setprecision(6) << "'";
        separator = ", \\\n  ";
        ++color;
    }
    text << "\n";
    return text.str();
}

/// The table, a script that draws it, and the chart where gnuplot is installed.
void writeChart(const std::filesystem::path& csv, const BenchRun& run, const std::vector<ScalingPoint>& points,
                const std::vector<ScalingFit>& fits) {
    writeScalingCsv(csv, points);
    std::filesystem::path script = csv;
    script.replace_extension(".gnuplot");
    writeText(script, scalingScript(csv, run, fits));
    if (!runGnuplot(script))
        std::cerr << "gnuplot is not installed; once it is, it draws the chart by " << script.string() << "\n";
}

nlohmann::ordered_json fitJson(const LogarithmicFit& fit) {
    return {{"constant", fit.constant}, {"perDoubling", fit.perDoubling}, {"rSquared", fit.rSquared}};
}

nlohmann::ordered_json scalingJson(const std::vector<ScalingPoint>& points, const std::vector<ScalingFit>& fits) {
    nlohmann::ordered_json pointList = nlohmann::ordered_json::array(), fitList = nlohmann::ordered_json::array();
    for (const ScalingPoint& point : points)
        pointList.push_back({{"rayKind", point.row.rayKind},
                             {"triangles", point.triangles},
                             {"nsPerRay", point.nsPerRay()},
                             {"nsLow", point.nsLow()},
                             {"nsHigh", point.nsHigh()},
                             {"nodesPerRay", point.nodesPerRay()}});
    for (const ScalingFit& fit : fits)
        fitList.push_back({{"rayKind", fit.rayKind}, {"ns", fitJson(fit.ns)}, {"nodes", fitJson(fit.nodes)}});
    return {{"points", pointList}, {"fits", fitList}};
}

void printFit(const char* unit, const LogarithmicFit& fit) {
    std::cout << std::setprecision(1) << fit.constant << " + " << std::setprecision(2) << fit.perDoubling << " log2(n) "
              << unit << " (R^2 " << std::setprecision(3) << fit.rSquared << ")";
}

}  // namespace

ExitCode benchScaling(const BenchOptions& options) {
    const RenderSettings settings = options.settings.resolve();
    Device device({settings.device, settings.validation});
    BenchRun run{device, resolveForDevice(settings, device.description()), options.repeats, measureHostMemory(), {}};
    const std::vector<ScalingPoint> points = measurePoints(run, options);
    const std::vector<ScalingFit> fits = fitPoints(points);
    if (!options.csv.empty()) writeChart(options.csv, run, points, fits);
    nlohmann::ordered_json json = benchJson(run);
    json["scaling"] = scalingJson(points, fits);
    if (!options.json.empty()) writeJson(options.json, json);
    if (options.json == "-") return ExitCode::done;
    for (const ScalingFit& fit : fits) {
        std::cout << fit.rayKind << ": ";
        printFit("ns a ray", fit.ns);
        std::cout << ", ";
        printFit("nodes a ray", fit.nodes);
        std::cout << "\n";
    }
    return ExitCode::done;
}

}  // namespace raylab
