#include "engine/render/triangle_record.h"
#include "tests/support/battery_test.h"

/// S7: the slab test must never cull what the triangle test would hit, 0 times infinity or not.
namespace raylab::support {
namespace {

using AxisRays = BatteryTest;

TEST_F(AxisRays, AreThoseOfBruteForce) {
    for (const TriangleTestInfo& test : triangleTests()) {
        RenderSettings settings;
        settings.triangle = test.name;
        const stability::AxisAnswers expected = stability::axisAnswers(contextOf(settings), 100'000);
        for (const LayoutInfo& layout : layouts()) {
            settings.layout = layout.name;
            expectPass(stability::measureAxisRaysAgainst(contextOf(settings), expected), nameOf(settings));
        }
    }
}

/// Without the guard, rays along axes are lost: what the setting is there to show.
TEST_F(AxisRays, ArePartlyLostByThePlainSlabTest) {
    RenderSettings settings;
    settings.slab = "plain";
    const std::vector<Number> numbers = stability::measureAxisRays(contextOf(settings, true));
    std::printf("plain slab test: %g of 10000 closest hits differ\n", numbers[0].value);
    EXPECT_GT(numbers[0].value, 0.0);
}

}  // namespace
}  // namespace raylab::support
