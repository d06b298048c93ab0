#include <nlohmann/json.hpp>

#include "engine/measure/chart_points.h"
#include "tests/editor/window.h"

namespace raylab {
namespace {

/// The panels that measure: Chart, Advice, Stability.
class MeasureWindowTest : public support::WindowTest {
protected:
    /// The user's shell: goes to the place that the script has reported to a file, with what else xdotool is told.
    static std::string onPlace(const std::string& file, const std::string& then) {
        return "while [ ! -s " + file + " ]; do sleep .05; done\nxdotool mousemove $(cat " + file + ")\nsleep .3\n" +
               then + "\n";
    }
};

const std::string kCornellToMeasure = "cornell --depth 3 --spp 2 ";

/// A chart of two depths, small enough for a test: 2 x 2 seeds x 2 levels.
const std::string kQueueDepths =
    "wait-samples 1\npanel Chart\nwait 0.2\n"
    "press chart-width\ntype 40\nkey Enter\n"
    "press chart-seeds\ntype 2\nkey Enter\n"
    "press chart-points\ntype 2\nkey Enter\n"
    "press chart-truth\ntype 0.2\nkey Enter\n"
    "press chart-add-vary\npress chart-vary-text\ntype depth=1,2\nkey Enter\n"
    "wait-until chart-queued == 2\n";

/// Points arrive; the real pointer on one shows its picture, and its click takes its settings as one step of undo;
/// what is exported is what was measured.
TEST_F(MeasureWindowTest, ChartsDepthsAdoptsAPointAndExports) {
    const std::string script = kQueueDepths +
                               "press chart-measure\nwait-until chart-running == 1\nwait-until chart-points > 0\n"
                               "wait-until chart-running == 0\nassert chart-points == 8\nlet-go\n"
                               "report-place chart-point-1-0 point\nwait-until chart-hovered == 1\nwait 0.2\n"
                               "screenshot hover.png\nwait-until depth == 2\nassert spp == 1\n"
                               "assert undo contains Adopt\nkey Ctrl+z\nassert depth == 3\nassert spp == 2\n"
                               "press chart-export\npress chart-export-write\nwait-idle\n"
                               "assert errors == 0\nassert validation == 0\nquit\n";
    const std::string user = onPlace("point", "while [ ! -e hover.png ]; do sleep .05; done\nxdotool click 1\n");
    EXPECT_EQ(runScript(kCornellToMeasure, script, user), 0) << readFile("log");
    const std::filesystem::path folder = folder_ / "chart-cornell";
    for (const char* name :
         {"chart.json", "chart.svg", "report.html", "chart.gnuplot", "pictures/00-1.png", "pictures/01-2-error.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
    const ChartTable table = readChartCsv(folder / "chart.csv");
    ASSERT_EQ(table.points.size(), 8u);
    // A single bounce leaves light out, which no number of samples brings back.
    double shallow = 0.0, deep = 0.0;
    for (const ChartPoint& p : table.points) {
        if (p.config == "depth=1" && p.samples == 2) shallow += 0.5 * p.error(ErrorMeasure::relative);
        if (p.config == "depth=2" && p.samples == 2) deep += 0.5 * p.error(ErrorMeasure::relative);
    }
    EXPECT_GT(shallow, 0.1);
    EXPECT_GT(deep, 0.0);
    const auto json = nlohmann::json::parse(readFile("chart-cornell/chart.json"));
    EXPECT_EQ(json.at("schema"), "raylab.chart/1");
    EXPECT_EQ(json.at("points").size(), 8u);
}

TEST_F(MeasureWindowTest, AChartThatIsStoppedOrWrongLeavesTheEditorAsItWas) {
    const std::string script =
        "wait-samples 1\npanel Chart\nwait 0.2\npress chart-add-vary\npress chart-vary-text\n"
        "type depht=1,2\nkey Enter\nwait-until errors == 1\nassert chart-queued == 0\nkey Esc\n"
        "press chart-add-current\nwait-until chart-queued == 1\npress chart-measure\nwait-until chart-running == 1\n"
        "wait-until phase != rendering\npress chart-stop\nwait-until chart-running == 0\nwait-idle\n"
        "assert errors == 1\nassert depth == 3\nquit\n";
    EXPECT_EQ(runScript(kCornellToMeasure, script), 0) << readFile("log");
    EXPECT_NE(readFile("log").find("depht"), std::string::npos);
}

TEST_F(MeasureWindowTest, TheTargetDialStopsTheRendering) {
    const std::string script =
        "wait-samples 4\npanel Chart\nwait 0.2\npress target-stop\nwait-until target-error > 0\n"
        "assert undo contains Stop\nkey Ctrl+z\nassert target-error == 0\nassert errors == 0\nquit\n";
    EXPECT_EQ(runScript("cornell --depth 3 --spp 64 ", script), 0) << readFile("log");
}

/// A search that is stopped changes nothing, and there is nothing to adopt.
TEST_F(MeasureWindowTest, AdviceThatIsStoppedLeavesTheEditorAsItWas) {
    const std::string script =
        "wait-samples 1\npanel Advice\nwait 0.2\npress advice-run\nwait-until advice-running == 1\n"
        "wait-until phase != rendering\npress advice-stop\nwait-until advice-running == 0\nwait-idle\n"
        "assert advice-steps == 0\nassert undo-steps == 0\nassert errors == 0\nquit\n";
    EXPECT_EQ(runScript(kCornellToMeasure, script), 0) << readFile("log");
}

/// A search of the depth alone (the first click elsewhere closes the list); what it found is one step of undo and a preset.
TEST_F(MeasureWindowTest, AdviceOnOneSettingIsAdoptedAndSaved) {
    std::string script = "wait-samples 1\npanel Advice\nwait 0.3\npress advice-width\ntype 32\nkey Enter\nwait 0.2\n"
                         "press advice-searched\nwait 0.2\n";
    for (const char* name : {"integrator", "light-choice", "sampler", "roulette-depth", "tracer", "layout", "builder",
                             "adaptive", "denoise"})
        script += std::string("press advice-search-") + name + "\n";
    script +=
        "screenshot searched.png\npress advice-run\nwait 0.3\npress advice-run\nwait-until advice-running == 1\n"
        "wait-until advice-running == 0\nassert advice-steps == 1\nwait 0.2\nscreenshot advice.png\n"
        "press advice-adopt\nwait-until undo-steps == 1\nassert undo contains advice\n"
        "press advice-save\nwait 0.2\nwait-until job == \"\"\nassert errors == 0\nquit\n";
    ASSERT_EQ(runScript(kCornellToMeasure, script), 0) << readFile("log");
    EXPECT_NE(readFile("cornell-fast.json").find("\"depth\""), std::string::npos);
}

/// Real clicks run the leaks of S1; a test for triangles that leaks has a row, whose scene opens with its wrong rays
/// and its settings; with the watertight test it heals.
TEST_F(MeasureWindowTest, RunsACaseAndShowsWhereItFails) {
    const std::string script =
        "wait-samples 1\npanel Stability\nwait 0.3\nreport-place stability-configs configs\n"
        "report-place stability-set-triangles set\nwait 0.5\nreport-place stability-run run\n"
        "wait-until stability-running == 1\nwait-until phase != rendering\nwait-until stability-running == 0\n"
        "assert stability-rows == 20\nwait 0.3\nscreenshot rows.png\nreport-place stability-row-5 row\n"
        "wait-until stability-evidence == 1\nreport-place stability-show show\nwait-until integrator == normal\n"
        "assert triangle == minimal\nwait-idle\nwait 0.2\nassert evidence-rays > 100\nscreenshot evidence.png\nassert "
        "evidence-pixels == 0\n"
        "set triangle watertight\nwait-idle\nassert errors == 0\nassert validation == 0\nquit\n";
    const std::string click = "xdotool click 1";
    EXPECT_EQ(runScript(kCornellToMeasure, script,
                        onPlace("configs", click) + onPlace("set", click) + onPlace("run", click) +
                            onPlace("row", click) + onPlace("show", click)),
              0)
        << readFile("log");
}

/// What passes keeps no picture.
TEST_F(MeasureWindowTest, ACaseThatPassesHasNothingToShow) {
    const std::string script =
        "wait-samples 1\npanel Stability\nwait 0.2\npress stability-case-S2\npress stability-run\n"
        "wait-until stability-running == 1\nwait-until stability-running == 0\nassert stability-rows == 3\n"
        "press stability-row-0\nwait 0.2\nassert stability-evidence == 0\nassert errors == 0\nquit\n";
    EXPECT_EQ(runScript(kCornellToMeasure, script), 0) << readFile("log");
}

}  // namespace
}  // namespace raylab
