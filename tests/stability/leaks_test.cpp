#include <array>

#include "tests/support/battery_test.h"

/// S1: light leaks at shared edges. Rays from inside closed meshes, half of them at vertices and edges.
namespace raylab::support {
namespace {

using Leaks = BatteryTest;

/// None at the origin; far away at most what Embree allows itself in its robust mode.
void expectTight(const std::vector<Number>& numbers, const std::string& what) {
    EXPECT_EQ(numbers[0].value, 0.0) << what;
    for (size_t i = 1; i < numbers.size(); ++i) EXPECT_LE(numbers[i].value, 2e-5) << what;
}

TEST_F(Leaks, DefaultIsTightInAMillionRays) {
    for (size_t scene = 0; scene < 3; ++scene)
        expectTight(stability::measureLeaksOf(contextOf({}), scene, 1'000'000), nameOf({}));
}

TEST_F(Leaks, WatertightIsTightInEveryLayout) {
    for (size_t scene = 0; scene < 3; ++scene)
        for (const RenderSettings& settings : everyLayout())
            expectTight(stability::measureLeaksOf(contextOf(settings), scene, 100'000), nameOf(settings));
}

/// Tests that are known to leak: twice what was measured on lavapipe, 50 rings at the origin and 200 far away. Where
/// one stops to leak, its row is to be moved up.
struct KnownLeak {
    const char* triangle;
    double mostAtOrigin;
    double mostFarAway;
};
constexpr std::array kKnownLeaks = {KnownLeak{"minimal", 0.104, 0.0203}, KnownLeak{"precomputed", 0.0755, 0.0228},
                                    KnownLeak{"baldwin-weber", 0.105, 0.0157}};

TEST_F(Leaks, OtherTestsLeakAsMuchAsIsKnown) {
    std::printf("%-40s %10s %10s\n", "leaks per million rays", "at origin", "far away");
    for (const KnownLeak& known : kKnownLeaks)
        for (RenderSettings settings : everyLayout()) {
            settings.triangle = known.triangle;
            const std::vector<Number> leaks = stability::measureLeaksOf(contextOf(settings), 0, 100'000);
            std::printf("%-40s %10.0f %10.0f\n", nameOf(settings).c_str(), 1e6 * leaks[0].value, 1e6 * leaks[1].value);
            EXPECT_GT(leaks[0].value, 0.0) << nameOf(settings);
            EXPECT_LE(leaks[0].value, known.mostAtOrigin) << nameOf(settings);
            EXPECT_GT(leaks[1].value, 0.0) << nameOf(settings);
            EXPECT_LE(leaks[1].value, known.mostFarAway) << nameOf(settings);
        }
}

}  // namespace
}  // namespace raylab::support
