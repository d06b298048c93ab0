#include "engine/image/image_io.h"
#include "tests/editor/window.h"
#include "tests/support/trace_choice.h"

namespace raylab {
namespace {

using support::WindowTest;

const std::string kCornellToLose = "cornell --depth 3 --spp 2 ";

TEST_F(WindowTest, GoesOnByTheSoftwareTracerAfterALossOfTheDevice) {
    RAYLAB_NEEDS_TRACER("query");
    RAYLAB_NEEDS_TRACER("pipeline");
    EXPECT_EQ(
        runScript(kCornellToLose + "--tracer query",
                  "wait-idle\nassert tracing == query\nset exposure 1\nset depth 2\n"
                  "simulate device-lost@render:2\nset depth 4\nwait-until recovery contains software\nwait-idle\n"
                  "assert tracing == software\nassert tracer == query\nassert depth == 4\nassert exposure == 1\n"
                  "assert undo-steps == 3\nassert picture-contrast > 10\nassert samples == 2\nassert errors == 0\n"
                  "screenshot recovered.png\nkey Ctrl+z\nassert depth == 2\nwait-idle\nassert tracing == software\n"
                  "set tracer pipeline\nwait-idle\nassert tracing == pipeline\nassert recovery == \"\"\n"
                  "assert validation == 0\nquit\n"),
        0)
        << readFile("log");
    EXPECT_NE(readFile("log").find("the device was lost"), std::string::npos) << readFile("log");
}

TEST_F(WindowTest, TriesOnceMoreBySoftwareAndThenWaitsForTheUser) {
    EXPECT_EQ(runScript(kCornellToLose,
                        "wait-idle\nsimulate device-lost@render:3,device-lost@render:3\nset depth 4\n"
                        "wait-until error contains F5\nassert errors == 1\nkey F5\nwait-idle\nassert error == \"\"\n"
                        "assert samples == 2\nassert depth == 4\nassert validation == 0\nquit\n"),
              0)
        << readFile("log");
}

/// The picture, its thumbnails and the interface come back on another device.
TEST_F(WindowTest, DrawsOnAFreshDeviceAfterALossOfItsOwn) {
    EXPECT_EQ(runScript(kCornellToLose,
                        "wait-idle\nset exposure 1\nwait-idle\nwait 0.5\nscreenshot before.png\n"
                        "simulate device-lost@frame:1\nwait 1\nwait-idle\nscreenshot after.png\nassert exposure == 1\n"
                        "assert undo-steps == 1\nkey Ctrl+z\nassert exposure == 0\nwait-idle\nassert validation == 0\n"
                        "assert errors == 0\nquit\n"),
              0)
        << readFile("log");
    EXPECT_NE(readFile("log").find("the window's device was lost"), std::string::npos) << readFile("log");
    const Bitmap before = readImage(folder_ / "before.png"), after = readImage(folder_ / "after.png");
    ASSERT_EQ(before.pixels.size(), after.pixels.size());
    // The log has a line more; the picture and the panels beside it are the same.
    size_t different = 0;
    for (int y = 0; y < before.height / 2; ++y)
        for (int x = 0; x < before.width; ++x)
            for (int c = 0; c < 3; ++c) different += before.at(x, y)[c] != after.at(x, y)[c] ? 1u : 0u;
    EXPECT_EQ(different, 0u);
}

}  // namespace
}  // namespace raylab
