#include "tests/support/battery_test.h"

/// S24: nothing at all, and more than fits into one storage buffer of lavapipe (128 MiB).
namespace raylab::support {
namespace {

using Limits = BatteryTest;

TEST_F(Limits, EmptySceneIsMissed) {
    std::vector<RenderSettings> choices = everyLayout();
    choices.push_back(bruteForce({}));
    for (const RenderSettings& settings : choices)
        expectPass(stability::measureEmpty(contextOf(settings)), nameOf(settings));
}

TEST_F(Limits, MoreTrianglesThanAStorageBufferHolds) {
    for (const char* layout : {"bvh4b", "bvh8q"}) {
        RenderSettings settings;
        settings.layout = layout;
        expectPass(stability::measureLarge(contextOf(settings)), layout);
    }
}

}  // namespace
}  // namespace raylab::support
