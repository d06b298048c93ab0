#include <algorithm>

#include "engine/image/image_io.h"
#include "tests/cli/program.h"

namespace raylab {
namespace {

using Count = ProgramTest;

TEST_F(Count, WritesPicturesHistogramsAndJson) {
    ASSERT_EQ(runProgram("count cornell --width 24 --height 16 --bounces 1 -o counts --json counts.json"), 0)
        << text("err");
    const Json counts = json("counts.json");
    EXPECT_EQ(counts["schema"], "raylab.count/1");
    ASSERT_EQ(counts["bounces"].size(), 2u);
    EXPECT_EQ(counts["bounces"][0]["rays"], 24 * 16);
    EXPECT_LE(counts["bounces"][1]["rays"], 24 * 16);
    const std::vector<Layer> layers = readExrLayers(folder_ / "counts/bounce0.exr");
    for (const char* name :
         {"steps", "nodes", "boxesTested", "boxesHit", "primitivesTested", "primitivesHit", "instances", "stackHigh"}) {
        const Json& field = counts["bounces"][0][name];
        uint64_t rays = 0;
        for (const Json& bin : field["histogram"]) rays += bin.get<uint64_t>();
        EXPECT_EQ(rays, 24u * 16u) << name;
        EXPECT_GE(field["most"], field["percentile99"]) << name;
        EXPECT_GE(field["percentile99"], field["median"]) << name;
        const auto layer = std::ranges::find(layers, name, &Layer::name);
        ASSERT_NE(layer, layers.end()) << name;
        double sum = 0.0;
        for (const float value : layer->bitmap.pixels) sum += value;
        EXPECT_NEAR(sum / (24.0 * 16.0), field["mean"].get<double>(), 1e-4) << name;
        EXPECT_EQ(readImage(folder_ / "counts" / ("bounce1-" + std::string(name) + ".png")).width, 24) << name;
    }
    EXPECT_GT(counts["bounces"][0]["steps"]["mean"], 1.0);
    EXPECT_NE(text("counts/histograms.csv").find("1,boxesHit,"), std::string::npos);
}

/// The tracer without a tree fetches no node and tests every triangle.
TEST_F(Count, BruteForceTestsAll) {
    ASSERT_EQ(runProgram("count cornell --width 8 --height 8 --bounces 0 --tracer brute --json brute.json"), 0)
        << text("err");
    ASSERT_EQ(runProgram("info cornell --json info.json"), 0);
    const Json primary = json("brute.json")["bounces"][0];
    EXPECT_EQ(primary["nodes"]["most"], 0);
    EXPECT_EQ(primary["primitivesTested"]["mean"], json("info.json")["instancedTriangles"]);
}

/// What a ray enters does not depend on the rays beside it in its subgroup: layouts that walk the nearest box first come
/// to nearly the same. (bvh4q enters what it has met, however near the hit that it found since.)
TEST_F(Count, InstancesAreThoseTheRayEnters) {
    double ofBinary = 0.0;
    for (const std::string layout : {"bvh2", "bvh2q", "bvh8q", "bvh4b"}) {
        ASSERT_EQ(runProgram("count materials --width 32 --height 18 --bounces 0 --trees mesh --json c.json --layout " + layout), 0)
            << text("err");
        const auto mean = json("c.json")["bounces"][0]["instances"]["mean"].get<double>();
        if (layout == "bvh2") ofBinary = mean;
        EXPECT_GT(mean, 0.9 * ofBinary) << layout;
        EXPECT_LT(mean, 1.25 * ofBinary) << layout;
    }
    EXPECT_GT(ofBinary, 0.5);
}

TEST_F(Count, RefusesWhatItCannotDo) {
    expectProgramRefuses("count nowhere.glb", "nowhere.glb");
    writeText("taken", "");
    expectProgramRefuses("count cornell --width 8 --height 8 -o taken", "taken");
}

TEST_F(Count, WritesTheWalkOfAPixelsRay) {
    ASSERT_EQ(runProgram("count cornell --width 32 --height 32 --bounces 0 --walk 16,16 --json a.json"), 0) << text("err");
    const Json walk = json("a.json")["walk"];
    EXPECT_EQ(walk["schema"], "raylab.ray-walk/1");
    EXPECT_GT(walk["steps"].size(), 2u);
    // Through the middle of the box, from 800 in front of it: nothing is in the way before the short block's face or the
    // back wall at z = 559.2.
    EXPECT_GT(walk["hit"]["t"], 800.0);
    EXPECT_LT(walk["hit"]["t"], 1400.0);
    expectProgramRefuses("count cornell --width 32 --height 32 --walk 32,0 --json a.json", "not in the picture");
    expectProgramRefuses("count cornell --width 32 --height 32 --walk 1,1", "--json");
}

TEST_F(Count, InfoListsTheNodesOfTheTrees) {
    ASSERT_EQ(runProgram("info cornell --nodes nodes.csv --json a.json"), 0) << text("err");
    const std::string csv = text("nodes.csv");
    EXPECT_EQ(csv.rfind("tree,node,parent", 0), 0u) << csv.substr(0, 80);
    EXPECT_EQ(static_cast<size_t>(std::count(csv.begin(), csv.end(), '\n')), json("a.json")["bvh"]["nodes"].get<size_t>() + 1);
    expectProgramRefuses("info cornell --nodes /proc/none/nodes.csv", "/proc/none");
}

}  // namespace
}  // namespace raylab
