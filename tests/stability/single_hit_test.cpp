#include "tests/support/battery_test.h"

/// S2: a square that is cut at random into triangles, as in the Khronos conformance tests: each ray must hit one of
/// them, and one only.
namespace raylab::support {
namespace {

using SingleHit = BatteryTest;

TEST_F(SingleHit, EachRayThroughACutSquare) {
    for (const RenderSettings& settings : everyLayout())
        expectPass(stability::measureSingleHit(contextOf(settings)), nameOf(settings));
}

/// The other triangle tests are not tight; measured on lavapipe: 2 misses and 1 double hit at most.
TEST_F(SingleHit, OtherTestsAreWrongAsOftenAsIsKnown) {
    for (const char* triangle : {"minimal", "precomputed", "baldwin-weber"}) {
        RenderSettings settings;
        settings.triangle = triangle;
        const std::vector<Number> numbers = stability::measureSingleHit(contextOf(settings));
        std::printf("%-20s misses %g doubles %g %s\n", triangle, numbers[0].value, numbers[1].value,
                    numbers[0].note.c_str());
        EXPECT_LE(numbers[0].value, 4.0) << triangle;
        EXPECT_LE(numbers[1].value, 2.0) << triangle;
    }
}

}  // namespace
}  // namespace raylab::support
