#include "engine/image/image_io.h"
#include "tests/cli/program.h"

namespace raylab {
namespace {

const std::string kSmall = "render cornell --width 32 --height 32 --integrator ao --spp 8 --quiet ";

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
        ASSERT_EQ(runProgram(kSmall + "-o calm.exr"), 0) << text("err");
        const Simulated simulated(failures);
        ASSERT_EQ(runProgram(kSmall + "--validation -o lost.exr --json lost.json --tracer " + tracer), 0)
            << text("err");
        EXPECT_EQ(image("lost.exr").pixels, image("calm.exr").pixels);
        EXPECT_EQ(json("lost.json")["deviceLosses"], losses);
        EXPECT_EQ(json("lost.json")["samples"], 8);
    }
};

TEST_F(DeviceLoss, LeavesAHardwareTracerForTheSoftwareTracer) {
    for (const std::string tracer : {"query", "pipeline"}) {
        expectSamePicture(tracer, "device-lost@render:3", 1);
        EXPECT_EQ(json("lost.json")["settings"]["tracer"], "software") << tracer;
        EXPECT_NE(text("err").find("software tracer takes over"), std::string::npos) << text("err");
    }
}

TEST_F(DeviceLoss, OverTheBuildOfStructuresLeavesThemToo) {
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
    expectSamePicture("pipeline", "device-lost@render:2,device-lost@render:2", 2);
    EXPECT_EQ(json("lost.json")["settings"]["slice-ms"], 25.0);
}

TEST_F(DeviceLoss, ForGoodEndsWithAMessageAndNoPicture) {
    const Simulated simulated("device-lost@render:3,device-lost@render:3");
    EXPECT_EQ(runProgram(kSmall + "-o lost.png"), 3);
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
    const Simulated simulated("device-lost@rays:2");
    EXPECT_EQ(runProgram("compare-tracers cornell --a software --b query --rays 10000 --quiet"), 3) << text("err");
    EXPECT_NE(text("err").find("VK_ERROR_DEVICE_LOST"), std::string::npos) << text("err");
}

TEST_F(DeviceLoss, IsSimulatedByAClearTextOnly) {
    const Simulated simulated("device-lost@render");
    expectProgramRefuses(kSmall + "-o lost.png", "device-lost@LABEL:N");
}

/// A build that runs out of memory, and whatever else is no loss, keeps the device.
TEST_F(DeviceLoss, IsNotWhatAFailedBuildIs) {
    for (const std::string tracer : {"query", "pipeline"}) {
        expectSamePicture(tracer, "out-of-memory@acceleration structures:1", 0);
        EXPECT_NE(text("err").find("the software tracer takes over"), std::string::npos) << text("err");
    }
}

}  // namespace
}  // namespace raylab
