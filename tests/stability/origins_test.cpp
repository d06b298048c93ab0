#include "tests/support/battery_test.h"

/// S4: surfaces that shadow themselves. S5: how far a ray's origin is moved off the surface that it leaves, which must
/// not be through what is close behind.
namespace raylab::support {
namespace {

using Origins = BatteryTest;

TEST_F(Origins, PlanesAreEvenlyLitAtEveryScale) { expectPass(stability::measurePlanes(contextOf({})), "default"); }

TEST_F(Origins, InstancesOfAnyScaleAreEvenlyLit) {
    expectPass(stability::measureScaledInstances(contextOf({})), "default");
}

TEST_F(Origins, LeavesDoNotShadowThemselves) { expectPass(stability::measureLeaves(contextOf({})), "default"); }

/// What the other offsets are there to show: 1e-3 is nothing at 1e5, and too much in a box 1e-4 high.
TEST_F(Origins, AFixedEpsilonFailsAtBothEnds) {
    RenderSettings settings;
    settings.offset = "epsilon";
    double acne = 0.0;
    for (const Number& number : stability::measurePlanes(contextOf(settings))) acne += number.value;
    EXPECT_GT(acne, 100.0);
    EXPECT_GT(stability::measureLowBoxes(contextOf(settings, true))[0].value, 100.0);
}

/// Hits within rounding of a side wall may be placed behind it: measured on lavapipe, 11 pixels of 1024 see the sky in
/// one of their 1000 rays. Twice that is the bound.
TEST_F(Origins, NoLightInALowBox) {
    for (const Number& number : stability::measureLowBoxes(contextOf({}))) {
        std::printf("%s: %g, %s\n", number.what.c_str(), number.value, number.note.c_str());
        EXPECT_LE(number.value, 22.0) << number.what;
    }
}

}  // namespace
}  // namespace raylab::support
