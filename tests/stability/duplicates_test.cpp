#include "engine/accel/builders.h"
#include "tests/support/battery_test.h"

/// S9: 10,000 identical triangles, by every builder and in every layout.
namespace raylab::support {
namespace {

using Duplicates = BatteryTest;

TEST_F(Duplicates, BuildFastAndTheSameTenTimesAndTheLowestIdWins) {
    std::vector<RenderSettings> choices = everyLayout();
    for (const BuilderInfo& builder : builders()) {
        choices.emplace_back();
        choices.back().builder = builder.name;
    }
    for (const RenderSettings& settings : choices)
        expectPass(stability::measureDuplicates(contextOf(settings)), nameOf(settings));
}

}  // namespace
}  // namespace raylab::support
