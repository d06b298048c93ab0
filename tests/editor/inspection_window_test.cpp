#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/editor/window.h"

namespace raylab {
namespace {

using support::WindowTest;

const std::string kCornellToInspect = "cornell --depth 2 --spp 1 ";

/// What `print NAME` left in the log.
double printed(const std::string& log, const std::string& name) {
    const size_t at = log.find(name + " = ");
    return at == std::string::npos ? -1.0 : std::stod(log.substr(at + name.size() + 3));
}

/// Boxes come with the key; a click selects a leaf, which F frames, and one beside everything selects nothing.
TEST_F(WindowTest, ShowsBoxesAndSelectsALeafByClick) {
    EXPECT_EQ(runScript(kCornellToInspect,
                        "wait-samples 1\npanel BVH\nkey b\nwait-until bvh-boxes > 10\nassert bvh-selected == -1\n"
                        "wait-until bvh-epo >= 0\nassert bvh-sah > 1\nremember camera-z\nscreenshot boxes.png\n"
                        "click v0.62 v0.55\nwait-until bvh-selected-leaf == 1\nassert selected == 0\n"
                        "key f\nwait-until camera-z != remembered\nkey Home\nwait 0.1\n"
                        "click v0.01 v0.01\nwait-until bvh-selected == -1\n"
                        "key b\nwait-until bvh-boxes == 0\nclick v0.5 v0.5\nwait-until selected == 1\n"
                        "assert errors == 0\nquit\n"),
              0)
        << readFile("log");
}

/// The table has a row for each node, and so has the file.
TEST_F(WindowTest, ListsNodesAndExportsThem) {
    EXPECT_EQ(runScript(kCornellToInspect,
                        "wait-samples 1\npanel Nodes\nwait-until bvh-nodes > 1\nprint bvh-nodes\nwait 0.3\n"
                        "click 280 535\nwait-until bvh-selected >= 0\nscreenshot nodes.png\n"
                        "click 607 490\nwait 0.2\nwait-until job == \"\"\nassert errors == 0\nquit\n"),
              0)
        << readFile("log");
    const std::string csv = readFile("raylab-nodes-1.csv");
    EXPECT_EQ(static_cast<double>(std::ranges::count(csv, '\n')), printed(readFile("log"), "bvh-nodes") + 1.0);
}

/// A ray is stepped through to its ends and not beyond; the walk that is exported is the one that was shown. One that
/// misses has no bounce.
TEST_F(WindowTest, StepsAlongARayAndExportsIt) {
    EXPECT_EQ(
        runScript(
            kCornellToInspect,
            "wait-samples 1\nkey Right\nassert ray-bounces == 0\nkey r\nwait-until bvh-sah > 1\nwait 0.2\n"
            "click v0.62 v0.55\nwait-until ray-bounces == 1\nassert ray-hit == 1\nassert ray-steps > 2\n"
            "assert ray-step == 0\nkey Left\nassert ray-step == 0\nkey Right\nkey Right\nassert ray-step == 2\n"
            "print ray-steps\nwait 0.2\nscreenshot step.png\nclick 658 490\nwait 0.2\nwait-until job == \"\"\n"
            "click 535 490\nwait-until ray-bounces == 2\nclick 595 490\nwait-until ray-bounces == 3\n"
            "key r\nclick v0.01 v0.01\nwait-until ray-hit == 0\nassert ray-bounces == 1\nclick 535 490\nwait 0.2\n"
            "assert ray-bounces == 1\nassert errors == 0\nquit\n"),
        0)
        << readFile("log");
    const auto walk = nlohmann::json::parse(readFile("raylab-walk-1.json"));
    EXPECT_EQ(walk.at("schema"), "raylab.ray-walk/1");
    EXPECT_EQ(static_cast<double>(walk.at("steps").size()), printed(readFile("log"), "ray-steps"));
    EXPECT_FALSE(walk.at("hit").is_null());
}

/// The same through two levels of trees: instances above meshes.
TEST_F(WindowTest, ShowsTheTreesOfMeshesBelowInstances) {
    EXPECT_EQ(runScript(kCornellToInspect + "--trees mesh ",
                        "wait-samples 1\npanel BVH\nkey b\nwait-until bvh-boxes > 10\nassert bvh-sah > 1\n"
                        "wait-until bvh-epo >= 0\nwait 0.2\nscreenshot mesh-boxes.png\n"
                        "click v0.62 v0.55\nwait-until bvh-selected-leaf == 1\nremember camera-z\nkey f\n"
                        "wait-until camera-z != remembered\nkey Home\npanel Nodes\nwait-until bvh-nodes > 1\n"
                        "key r\nclick v0.62 v0.55\nwait-until ray-bounces == 1\nassert ray-hit == 1\n"
                        "assert ray-steps > 3\nkey Right\nkey Right\nassert ray-step == 2\nwait 0.2\n"
                        "screenshot mesh-step.png\nassert errors == 0\nassert validation == 0\nquit\n"),
              0)
        << readFile("log");
}

/// Counts follow the view.
TEST_F(WindowTest, CountsWhatRaysCost) {
    EXPECT_EQ(runScript(kCornellToInspect,
                        "wait-samples 1\npanel Counts\nkey c\nwait-until counts-rays > 1000\nassert counts-mean > 1\n"
                        "assert counts-high > 1\nassert counts-most < 100\n"
                        "wait 0.3\nscreenshot counts.png\nremember counts-mean\nhold w 0.4\n"
                        "wait-until counts-mean != remembered\nassert errors == 0\nquit\n"),
              0)
        << readFile("log");
}

/// Another builder makes another tree, to which the overlay switches.
TEST_F(WindowTest, ComparesTwoBuilds) {
    EXPECT_EQ(runScript(kCornellToInspect,
                        "wait-samples 1\npanel BVH\nwait-until bvh-sah > 1\nremember bvh-sah\n"
                        "click 100 239\nwait 0.2\nclick 100 289\nwait 0.2\nclick 20 314\nwait-until bvh-b-sah > 1\n"
                        "assert bvh-sah == remembered\nremember bvh-b-sah\n"
                        "click 75 364\nwait 0.2\nclick 40 408\nwait-until bvh-b-sah != remembered\n"
                        "click 142 82\nwait-until bvh-sah != remembered\nscreenshot builds.png\nassert errors == 0\n"
                        "quit\n"),
              0)
        << readFile("log");
}

}  // namespace
}  // namespace raylab
