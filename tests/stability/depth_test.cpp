#include "tests/support/battery_test.h"

/// S10: inputs that make deep trees. A stack that overflows loses hits.
namespace raylab::support {
namespace {

using Depth = BatteryTest;

TEST_F(Depth, BuildersKeepTheirCap) { expectPass(stability::measureTreeDepth(contextOf({})), "1e6 equal centroids"); }

TEST_F(Depth, NoHitIsLostInAnyLayout) {
    for (const RenderSettings& settings : everyLayout())
        expectPass(stability::measureDepth(contextOf(settings)), nameOf(settings));
}

/// A detailed thing in a world 1e6 units wide.
TEST_F(Depth, NoHitIsLostOnADragonInAStadium) {
    for (const RenderSettings& settings : everyLayout()) {
        const std::vector<Number> numbers = measureOrSkip(stability::measureStadium, contextOf(settings));
        if (numbers.empty()) return;
        expectPass(numbers, nameOf(settings));
    }
}

}  // namespace
}  // namespace raylab::support
