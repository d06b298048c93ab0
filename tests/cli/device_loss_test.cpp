#include <map>
#include <sstream>

#include "engine/image/image_io.h"
#include "tests/cli/program.h"
#include "tests/support/trace_choice.h"

namespace raylab {
namespace {

const std::string kSmallRender = "render cornell --width 32 --height 32 --integrator ao --spp 8 --quiet ";

/// Failures that raylab simulates as long as this lives.
class Simulated {
public:
    explicit Simulated(const std::string& failures) { ::setenv("RAYLAB_SIMULATE", failures.c_str(), 1); }
    ~Simulated() { ::unsetenv("RAYLAB_SIMULATE"); }
    Simulated(const Simulated&) = delete;
    Simulated& operator=(const Simulated&) = delete;
};

class DeviceLoss : public ProgramTest {
protected:
    Bitmap image(const std::string& name) const { return readImage(folder_ / name); }
    /// Renders by a tracer while `failures` happen, and compares with the picture that the software tracer makes when
    /// nothing happens.
    void expectSamePicture(const std::string& tracer, const std::string& failures, int losses) const {
        ASSERT_EQ(runProgram(kSmallRender + "-o calm.exr"), 0) << text("err");
        const Simulated simulated(failures);
        ASSERT_EQ(runProgram(kSmallRender + "--validation -o lost.exr --json lost.json --tracer " + tracer), 0)
            << text("err");
        EXPECT_EQ(image("lost.exr").pixels, image("calm.exr").pixels);
        EXPECT_EQ(json("lost.json")["deviceLosses"], losses);
        EXPECT_EQ(json("lost.json")["samples"], 8);
    }
};

TEST_F(DeviceLoss, LeavesAHardwareTracerForTheSoftwareTracer) {
    for (const std::string tracer : {"pipeline", "query"}) {
        RAYLAB_NEEDS_TRACER(tracer);
        expectSamePicture(tracer, "device-lost@render:3", 1);
        EXPECT_EQ(json("lost.json")["settings"]["tracer"], "software") << tracer;
        EXPECT_NE(text("err").find("software tracer takes over"), std::string::npos) << text("err");
    }
}

TEST_F(DeviceLoss, OverTheBuildOfStructuresLeavesThemToo) {
    RAYLAB_NEEDS_TRACER("query");
    expectSamePicture("query", "device-lost@acceleration structures:1", 1);
    EXPECT_EQ(json("lost.json")["settings"]["tracer"], "software");
}

TEST_F(DeviceLoss, OnSoftwareTracersIsFollowedByShorterDispatches) {
    for (const std::string tracer : {"software", "brute"}) {
        expectSamePicture(tracer, "device-lost@render:4", 1);
        EXPECT_EQ(json("lost.json")["settings"]["tracer"], tracer);
        EXPECT_EQ(json("lost.json")["settings"]["slice-ms"], 25.0);
    }
}

TEST_F(DeviceLoss, TwiceInARowComesThroughFromAHardwareTracer) {
    RAYLAB_NEEDS_TRACER("pipeline");
    expectSamePicture("pipeline", "device-lost@render:2,device-lost@render:2", 2);
    EXPECT_EQ(json("lost.json")["settings"]["slice-ms"], 25.0);
}

TEST_F(DeviceLoss, ForGoodEndsWithAMessageAndNoPicture) {
    const Simulated simulated("device-lost@render:3,device-lost@render:3");
    EXPECT_EQ(runProgram(kSmallRender + "-o lost.png"), 3);
    EXPECT_NE(text("err").find("VK_ERROR_DEVICE_LOST"), std::string::npos) << text("err");
    EXPECT_NE(text("err").find("--slice-ms"), std::string::npos) << text("err");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "lost.png"));
}

TEST_F(DeviceLoss, ForGoodLeavesTheLastLookAtTheNoise) {
    const Simulated simulated("device-lost@render:250,device-lost@render:2");
    EXPECT_EQ(runProgram("render cornell --width 512 --height 512 --integrator normal --spp 1000000 --slice-ms 10 "
                         "--quiet -o lost.exr --json lost.json"),
              3)
        << text("err");
    ASSERT_TRUE(std::filesystem::exists(folder_ / "lost.exr")) << text("err");
    EXPECT_EQ(json("lost.json")["stoppedBy"], "device-loss");
    const auto samples = json("lost.json")["samples"].get<uint32_t>();
    EXPECT_GE(samples, 2u);
    EXPECT_LT(samples, 1000000u);
    EXPECT_GE(json("lost.json")["samplesPerPixel"]["least"].get<double>(), samples);
}

TEST_F(DeviceLoss, OfAMeasurementIsNoResult) {
    RAYLAB_NEEDS_TRACER("query");
    const Simulated simulated("device-lost@rays:2");
    EXPECT_EQ(runProgram("compare-tracers cornell --a software --b query --rays 10000 --quiet"), 3) << text("err");
    EXPECT_NE(text("err").find("VK_ERROR_DEVICE_LOST"), std::string::npos) << text("err");
}

/// The table of a chart without its times and what follows from them.
std::map<std::string, std::vector<std::string>> pointsOf(const std::string& csv) {
    std::map<std::string, std::vector<std::string>> points;
    std::istringstream stream(csv);
    for (std::string line; std::getline(stream, line);) {
        std::vector<std::string> fields;
        std::istringstream fieldStream(line);
        for (std::string field; std::getline(fieldStream, field, ',');) fields.push_back(field);
        points[fields.at(0) + " " + fields.at(1) + " " + fields.at(2)] = {fields.at(5), fields.at(6), fields.at(7)};
    }
    return points;
}

const std::string kSmallChart =
    "chart cornell --width 24 --height 24 --depth 2 --vary sampler=sobol,independent --seeds 2 --points 3 --reference "
    "reference.exr --quiet -o ";

class ChartLoss : public DeviceLoss {
protected:
    void SetUp() override {
        ASSERT_EQ(runProgram("render cornell --width 24 --height 24 --depth 2 --spp 16 --quiet -o reference.exr"), 0);
        ASSERT_EQ(runProgram(kSmallChart + "calm"), 0) << text("err");
    }
    void expectSamePoints(const std::string& folder) const {
        EXPECT_EQ(pointsOf(text(folder + "/chart.csv")), pointsOf(text("calm/chart.csv")));
    }
};

TEST_F(ChartLoss, GoesOnFromItsPointsOnAFreshDevice) {
    const Simulated simulated("device-lost@render:40");
    ASSERT_EQ(runProgram(kSmallChart + "lost"), 0) << text("err");
    EXPECT_NE(text("err").find("points are kept; the chart goes on"), std::string::npos) << text("err");
    expectSamePoints("lost");
}

TEST_F(ChartLoss, ForGoodKeepsItsPointsForTheSameCommand) {
    {
        const Simulated simulated("device-lost@render:40,device-lost@render:1");
        EXPECT_EQ(runProgram(kSmallChart + "lost"), 3) << text("err");
        EXPECT_NE(text("err").find("the same command goes on from there"), std::string::npos) << text("err");
        EXPECT_NE(json("lost/chart.json")["deviceLoss"].get<std::string>().find("VK_ERROR_DEVICE_LOST"),
                  std::string::npos);
        EXPECT_GT(pointsOf(text("lost/chart.csv")).size(), 1u);
        EXPECT_LT(pointsOf(text("lost/chart.csv")).size(), pointsOf(text("calm/chart.csv")).size());
    }
    // A device that gives up on long dispatches may do with shorter ones.
    ASSERT_EQ(runProgram(kSmallChart + "lost --slice-ms 10"), 0) << text("err");
    expectSamePoints("lost");
}

const std::string kSmallAdvice =
    "advise cornell --width 16 --height 16 --depth 2 --target-error 0.5 --only roulette-depth -o p.json --json a.json "
    "--quiet";

TEST_F(DeviceLoss, OfASearchGoesOnOnAFreshDevice) {
    const Simulated simulated("device-lost@render:40");
    ASSERT_EQ(runProgram(kSmallAdvice), 0) << text("err");
    EXPECT_NE(text("err").find("the search goes on from there"), std::string::npos) << text("err");
    ASSERT_EQ(json("a.json")["steps"].size(), 1u);
    EXPECT_GE(json("a.json")["forecast"]["samples"].get<int>(), 1);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "p.json"));
}

TEST_F(DeviceLoss, OfASearchForGoodIsToldWithItsSteps) {
    const Simulated simulated("device-lost@render:40,device-lost@render:1");
    EXPECT_EQ(runProgram(kSmallAdvice), 3) << text("err");
    EXPECT_NE(text("err").find("so there is no preset"), std::string::npos) << text("err");
    EXPECT_NE(json("a.json")["deviceLoss"].get<std::string>().find("VK_ERROR_DEVICE_LOST"), std::string::npos);
    EXPECT_TRUE(json("a.json")["steps"].empty());
    EXPECT_FALSE(std::filesystem::exists(folder_ / "p.json"));
}

TEST_F(DeviceLoss, FailsACaseOfStabilityAndNoOther) {
    const Simulated simulated("device-lost@rays:2");
    EXPECT_EQ(runProgram("stability --case S7,S9,S24 --quick --json a.json -o report"), 1) << text("err");
    const Json result = json("a.json");
    EXPECT_TRUE(result["complete"].get<bool>());
    for (const Json& row : result["rows"]) {
        if (row["id"] == "S7") {
            EXPECT_EQ(row["pass"], false) << row;
            EXPECT_NE(row["note"].get<std::string>().find("VK_ERROR_DEVICE_LOST"), std::string::npos) << row;
        } else {
            EXPECT_NE(row["pass"], false) << row;
        }
    }
}

TEST_F(DeviceLoss, KeepsTheRowsOfABenchmark) {
    const std::string bench =
        "bench cornell mirrors --width 16 --height 16 --repeats 1 --rays primary --no-peers --csv a.csv --json a.json";
    ASSERT_EQ(runProgram(bench), 0) << text("err");
    ASSERT_EQ(json("a.json")["rows"].size(), 2u);
    const Simulated simulated("device-lost@rays:12");
    EXPECT_EQ(runProgram(bench), 3) << text("err");
    EXPECT_NE(text("err").find("is kept (rows: 1)"), std::string::npos) << text("err");
    ASSERT_EQ(json("a.json")["rows"].size(), 1u);
    EXPECT_EQ(json("a.json")["rows"][0]["scene"], "cornell");
    EXPECT_NE(text("a.csv").find("\ncornell,"), std::string::npos);
}

TEST_F(DeviceLoss, IsSimulatedByAClearTextOnly) {
    const Simulated simulated("device-lost@render");
    expectProgramRefuses(kSmallRender + "-o lost.png", "device-lost@LABEL:N");
}

/// A build that runs out of memory, and whatever else is no loss, keeps the device.
TEST_F(DeviceLoss, IsNotWhatAFailedBuildIs) {
    for (const std::string tracer : {"pipeline", "query"}) {
        RAYLAB_NEEDS_TRACER(tracer);
        expectSamePicture(tracer, "out-of-memory@acceleration structures:1", 0);
        EXPECT_NE(text("err").find("the software tracer takes over"), std::string::npos) << text("err");
    }
}

}  // namespace
}  // namespace raylab
