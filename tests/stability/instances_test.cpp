#include "tests/support/battery_test.h"

/// S11: matrices of all kinds, and no instance at all. S12: scenes that are very small or very large.
namespace raylab::support {
namespace {

using Instances = BatteryTest;

TEST_F(Instances, OfAllMatricesAreHit) {
    for (const RenderSettings& settings : everyLayout())
        expectPass(stability::measureInstances(contextOf(settings)), nameOf(settings));
}

TEST_F(Instances, TrucksMirroredShearedAndSingular) {
    for (const RenderSettings& settings : everyLayout()) {
        const std::vector<Number> numbers = measureOrSkip(stability::measureTrucks, contextOf(settings));
        if (numbers.empty()) return;
        expectPass(numbers, nameOf(settings));
    }
}

/// S12, the bead of 1e-3 beside a plane of 1e4 too: the error of a distance must not grow with the triangle.
TEST_F(Instances, ScaleDoesNotShow) {
    for (const RenderSettings& settings : everyLayout())
        expectPass(stability::measureScales(contextOf(settings)), nameOf(settings));
}

}  // namespace
}  // namespace raylab::support
