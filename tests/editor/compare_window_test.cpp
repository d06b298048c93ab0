#include <glm/glm.hpp>

#include "engine/image/image_io.h"
#include "tests/editor/window.h"
#include "tests/support/trace_choice.h"

namespace raylab {
namespace {

class CompareWindowTest : public support::WindowTest {
protected:
    /// What the script printed of a value.
    double printed(const std::string& name) const {
        const std::string log = readFile("log"), mark = name + " = ";
        const size_t at = log.find(mark);
        return at == std::string::npos ? -1.0 : std::stod(log.substr(at + mark.size()));
    }
};

const std::string kCornellToCompare = "cornell --depth 2 --spp 2 ";

TEST_F(CompareWindowTest, ComparesEqualConfigurationsAndFindsNoDifference) {
    RAYLAB_NEEDS_TRACER("query");
    EXPECT_EQ(runScript(kCornellToCompare,
                        "wait-idle\ncompare absolute\nwait-idle\nwait-until samples-b == 2\n"
                        "wait-until difference == 0\ncompare \"first hit\"\nwait-until difference == 0\n"
                        "set-b tracer query\nwait-until tracing-b == query\nwait-idle\nwait-until difference < 0.001\n"
                        "assert tracing == software\nassert errors == 0\nassert validation == 0\nquit\n"),
              0)
        << readFile("log");
}

TEST_F(CompareWindowTest, ComparesTwoIntegratorsInAllModes) {
    EXPECT_EQ(
        runScript(kCornellToCompare,
                  "wait-idle\nkey v\nassert compare == wipe\nset-b integrator normal\nwait-idle\n"
                  "panel A/B\nwait 0.2\nscreenshot wipe.png\ndrag v0.5 v0.5 v0.25 v0.5\nwait-until wipe < 0.3\n"
                  "assert wipe > 0.2\ncompare checker\nwait 0.1\ncompare blink\nwait 0.8\ncompare \"side by side\"\n"
                  "wait-idle\ncompare relative\nwait-idle\nwait-until difference > 0.1\ncompare FLIP\nwait-idle\n"
                  "wait-until difference > 0.05\ncompare Z-score\nwait-idle\nwait-until difference > 0.5\n"
                  "screenshot z.png\nkey v\nassert compare == off\nkey v\nassert compare == Z-score\n"
                  "assert errors == 0\nquit\n"),
        0)
        << readFile("log");
    const Bitmap window = readImage(folder_ / "wipe.png");
    // The back wall, right of the line by its normal, -Z: without any blue.
    const float *a = window.at(590, 190), *b = window.at(640, 190);
    EXPECT_LT(b[2], 0.05f);
    EXPECT_GT(b[0], 0.4f);
    EXPECT_LT(a[0], b[0]);
}

/// The error of an average goes with the root of the number of samples, and the cost of a sample is that of the other
/// side: the configurations differ in --spp alone.
TEST_F(CompareWindowTest, MeasuresErrorAndTimeOfBothSides) {
    EXPECT_EQ(
        runScript("cornell --depth 2 --spp 16 ",
                  "wait-samples 1\ncompare wipe\nset-b spp 4\nwait-until samples == 16\nwait-until samples-b == 4\n"
                  "wait-idle\nassert error-a > 0\nassert cost-a > 0\nassert cost-b > 0\n"
                  "print error-a\nprint error-b\npanel A/B\nwait 0.2\nscreenshot figures.png\nquit\n"),
        0)
        << readFile("log");
    const double ratio = printed("error-b") / printed("error-a");
    EXPECT_NEAR(ratio, 2.0, 0.4);
}

/// What B is told before it is shown holds; all else is A's.
TEST_F(CompareWindowTest, BIsSetBeforeItIsShown) {
    EXPECT_EQ(runScript(kCornellToCompare,
                        "wait-idle\nset-b integrator normal\nassert integrator == path\nkey v\n"
                        "compare relative\nwait-until samples-b == 2\nwait-until difference > 0.1\n"
                        "key Alt+v\nassert integrator == normal\nassert depth == 2\nassert spp == 2\n"
                        "assert errors == 0\nquit\n"),
              0)
        << readFile("log");
}

TEST_F(CompareWindowTest, SwapsAndTakesBsSettingsAsOneStep) {
    EXPECT_EQ(
        runScript(
            kCornellToCompare,
            "wait-idle\ncompare checker\nset-b depth 7\nkey Shift+v\nassert depth == 7\nassert undo contains Swap\n"
            "wait-idle\nset-b depth 9\nkey Alt+v\nassert depth == 9\nkey Ctrl+z\nassert depth == 7\n"
            "set-b integrator nonsense\nquit\n"),
        1)
        << readFile("log");
    EXPECT_NE(readFile("log").find("nonsense"), std::string::npos) << readFile("log");
}

TEST_F(CompareWindowTest, ASideThatCannotBePreparedSaysSo) {
    EXPECT_EQ(
        runScript(kCornellToCompare,
                  "wait-idle\ncompare wipe\nset-b environment nowhere.hdr\nwait-until error-of-b contains nowhere.hdr\n"
                  "wait-idle\nassert samples == 2\nset-b environment none\nwait-until error-of-b == \"\"\nwait-until "
                  "samples-b == 2\nquit\n"),
        0)
        << readFile("log");
}

}  // namespace
}  // namespace raylab
