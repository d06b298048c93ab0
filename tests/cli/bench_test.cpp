#include <algorithm>
#include <set>
#include <sstream>

#include "tests/cli/program.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

const std::string kFewRays = " --width 16 --height 16 --repeats 2";

using Bench = ProgramTest;

/// The file with every rate of some rows multiplied, and intervals so wide that a busy machine does not leave them.
std::string scaled(Json run, double factor, const std::string& onlyTracer = "") {
    constexpr double kWide = 10.0;
    for (Json& row : run["rows"]) {
        const double scale = onlyTracer.empty() || row["tracer"] == onlyTracer ? factor : 1.0;
        row["mraysPerSecond"] = row["mraysPerSecond"].get<double>() * scale;
        row["low"] = row["low"].get<double>() * scale / kWide;
        row["high"] = row["high"].get<double>() * scale * kWide;
    }
    return run.dump();
}

bool hasTracer(const Json& run, const std::string& tracer) {
    return std::ranges::any_of(run["rows"], [&](const Json& row) { return row["tracer"] == tracer; });
}

TEST_F(Bench, RowsSayWhatOthersRelyOn) {
    ASSERT_EQ(
        runProgram("bench cornell --rays primary,shadow --vary layout=bvh2,bvh4b --json a.json --csv a.csv" + kFewRays),
        0)
        << text("err");
    const Json result = json("a.json");
    EXPECT_EQ(result["schema"], "raylab.bench/1");
    EXPECT_EQ(result["settings"]["layout"], "bvh2");  // resolved: the box is tiny
    EXPECT_GT(result["memory"]["gather64MiBBytesPerSecond"], 0.0);
    std::set<std::string> kinds, layouts;
    for (const Json& row : result["rows"]) {
        EXPECT_EQ(row["scene"], "cornell");
        EXPECT_LE(row["low"], row["mraysPerSecond"]);
        EXPECT_LE(row["mraysPerSecond"], row["high"]);
        EXPECT_GT(row["low"], 0.0);
        kinds.insert(row["rayKind"].get<std::string>());
        if (row["tracer"] != "software") continue;
        layouts.insert(row["layout"].get<std::string>());
        EXPECT_EQ(row["triangle"], "watertight");
        EXPECT_EQ(row["builder"], "auto");
        EXPECT_EQ(row["variation"], "");
        // At least a node of 48 bytes and the instance.
        EXPECT_GE(row["perRay"]["bytes"], 48.0);
        EXPECT_NEAR(row["bytesPerSecond"].get<double>(),
                    row["perRay"]["bytes"].get<double>() * row["mraysPerSecond"].get<double>() * 1e6, 1.0);
    }
    EXPECT_EQ(kinds, (std::set<std::string>{"primary", "shadow"}));
    EXPECT_EQ(layouts, (std::set<std::string>{"bvh2", "bvh4b"}));
    EXPECT_TRUE(hasTracer(result, "scalar"));
    const std::string csv = text("a.csv");
    EXPECT_EQ(static_cast<size_t>(std::ranges::count(csv, '\n')), result["rows"].size() + 1);
}

TEST_F(Bench, CostsAreFittedPerLayout) {
    ASSERT_EQ(runProgram("bench cornell --costs --vary layout=bvh2,bvh2q --rays primary,shadow,diffuse --json a.json" +
                         kFewRays),
              0)
        << text("err");
    const Json result = json("a.json");
    std::set<std::string> layouts;
    for (const Json& costs : result["costs"]) {
        layouts.insert(costs["layout"].get<std::string>());
        EXPECT_EQ(costs["triangle"], "watertight");
        // Three kinds of rays, four views, two trees; a view that sees nothing has primary rays alone.
        EXPECT_GE(costs["samples"], 4 * 2);
        EXPECT_LE(costs["samples"], 3 * 4 * 2);
        EXPECT_GT(costs["nsPerNode"]["standardError"], 0.0);
        EXPECT_GT(costs["relativeResidual"], 0.0);
    }
    EXPECT_EQ(layouts, (std::set<std::string>{"bvh2", "bvh2q"}));
    EXPECT_EQ(runProgram("bench cornell --costs --tune" + kFewRays), 2) << text("err");
}

TEST_F(Bench, CompareFindsWhatBecameSlower) {
    const std::string bench = "bench cornell --rays primary" + kFewRays;
    ASSERT_EQ(runProgram(bench + " --json a.json"), 0) << text("err");
    const Json before = json("a.json");
    writeText("faster.json", scaled(before, 1e-4, "software"));
    EXPECT_EQ(runProgram(bench + " --compare faster.json --json new.json"), 0) << text("err");
    EXPECT_EQ(json("new.json")["compare"]["faster"], 1);
    writeText("slower.json", scaled(before, 1e4, "software"));
    EXPECT_EQ(runProgram(bench + " --compare slower.json"), 1) << text("err");
    EXPECT_NE(text("out").find("SLOWER"), std::string::npos) << text("out");
    writeText("machine.json", scaled(before, 1e4));
    EXPECT_EQ(runProgram(bench + " --compare machine.json"), hasTracer(before, "embree1") ? 0 : 1) << text("out");
    EXPECT_EQ(runProgram(bench + " --compare machine.json --no-peers"), 1) << text("out");
}

TEST_F(Bench, OldFilesThatAreNoneAreRefused) {
    const std::string bench = "bench cornell --rays primary --no-peers" + kFewRays + " --compare ";
    writeText("torn.json", "{\"schema\": \"raylab.bench/1\", \"rows\": [");
    writeText("other.json", "{\"schema\": \"raylab.render/1\"}");
    writeText("rows.json", "{\"schema\": \"raylab.bench/1\", \"rows\": [{\"scene\": 3}]}");
    writeText("none.json", "{\"schema\": \"raylab.bench/1\", \"rows\": []}");
    for (const char* name : {"torn.json", "other.json", "rows.json", "none.json", "missing.json"})
        expectProgramRefuses(bench + name, name);
}

TEST_F(Bench, WrongUsageIsRefused) {
    expectProgramRefuses("bench", "name a scene");
    expectProgramRefuses("bench cornell --scaling", "--scaling");
    expectProgramRefuses("bench cornell --tune --vary layout=bvh2", "--tune");
    expectProgramRefuses("bench cornell --vary layout", "NAME=A,B,C");
    expectProgramRefuses("bench cornell --rays sideways", "--rays");
    expectProgramRefuses("bench cornell --light 1,2", "--light");
    expectProgramRefuses("bench nowhere.glb", "nowhere.glb");
}

/// A strip of 300 triangles as OBJ: more than a tiny scene has, for which `auto` is what it is on the device.
std::string stripObj() {
    std::ostringstream obj;
    for (int i = 0; i <= 150; ++i) obj << "v " << i << " 0 0\nv " << i << " 1 0\n";
    for (int v = 1; v < 301; v += 2)
        obj << "f " << v << " " << v + 2 << " " << v + 1 << "\nf " << v + 1 << " " << v + 2 << " " << v + 3 << "\n";
    return obj.str();
}

TEST_F(Bench, TuneRecordsWhatAutoTakes) {
    writeText("strip.obj", stripObj());
    ASSERT_EQ(runProgram("bench cornell --tune --json tune.json" + kFewRays), 0) << text("err");
    const Json tune = json("tune.json")["tune"];
    EXPECT_GE(tune["ranking"].size(), 10u);
    double last = 1e300;
    std::string best;
    for (const Json& entry : tune["ranking"]) {
        EXPECT_LE(entry["mraysPerSecond"], last);
        last = entry["mraysPerSecond"];
        if (best.empty() && entry["triangle"] == "watertight") best = entry["layout"];
    }
    EXPECT_EQ(tune["recorded"], best);
    // Another than the default, whatever was fastest.
    Json recorded = json("raylab/devices.json");
    EXPECT_EQ(recorded["devices"].at(0)["layout"], best);
    recorded["devices"].at(0)["layout"] = "bvh8q";
    writeText("raylab/devices.json", recorded.dump());
    const std::string render = "render strip.obj -o a.png --width 16 --height 16 --spp 1 --json a.json";
    ASSERT_EQ(runProgram(render + " --layout auto"), 0) << text("err");
    EXPECT_EQ(json("a.json")["settings"]["layout"], "bvh8q");
    ASSERT_EQ(runProgram(render + " --layout bvh2"), 0) << text("err");
    EXPECT_EQ(json("a.json")["settings"]["layout"], "bvh2");
    writeText("raylab/devices.json", "{");
    ASSERT_EQ(runProgram(render), 0) << text("err");
    EXPECT_EQ(json("a.json")["settings"]["layout"], "bvh4b");
    EXPECT_NE(text("err").find("devices.json"), std::string::npos);
}

TEST_F(Bench, ScalingWritesItsPointsAndAScript) {
    ASSERT_EQ(runProgram("bench --scaling --largest 10000 --csv cost.csv --json a.json" + kFewRays), 0) << text("err");
    const Json scaling = json("a.json")["scaling"];
    EXPECT_EQ(scaling["points"].size(), 4u);  // two sizes, two kinds of rays
    for (const Json& point : scaling["points"]) EXPECT_GT(point["nsPerRay"], 0.0);
    for (const Json& fit : scaling["fits"]) EXPECT_GT(fit["nodes"]["perDoubling"], 0.0);
    EXPECT_EQ(std::ranges::count(text("cost.csv"), '\n'), 5);
    EXPECT_NE(text("cost.gnuplot").find("'cost.csv'"), std::string::npos);
    EXPECT_TRUE(fs::exists(folder_ / "cost.svg") || text("err").find("gnuplot") != std::string::npos);
}

TEST_F(Bench, InfoMeasuresTreesWhereItIsAsked) {
    ASSERT_EQ(runProgram("info cornell --json a.json"), 0) << text("err");
    EXPECT_TRUE(json("a.json")["bvh"]["epo"].is_null());
    ASSERT_EQ(runProgram("info cornell --bvh --builder spatial --layout bvh8q --leaf-size 2 --json a.json"), 0)
        << text("err");
    const Json bvh = json("a.json")["bvh"];
    EXPECT_EQ(bvh["builder"], "spatial");
    EXPECT_EQ(bvh["layout"], "bvh8q");
    EXPECT_GE(bvh["epo"], 0.0);
    EXPECT_GE(bvh["flattenMs"], 0.0);
    EXPECT_LE(bvh["leafSizeHistogram"].size(), 3u);
    EXPECT_GT(bvh["memoryBytes"]["triangles"], 0);
    EXPECT_NE(text("out").find("leaves by depth"), std::string::npos) << text("out");
    expectProgramRefuses("info cornell --bvh --builder best", "--builder");
}

}  // namespace
}  // namespace raylab
