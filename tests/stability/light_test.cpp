#include "tests/support/battery_test.h"

/// S13, S21: lights, cameras and values in places where a formula divides by zero. S16, S17, S19, S20: light that is
/// exactly known.
namespace raylab::support {
namespace {

using Lights = BatteryTest;

TEST_F(Lights, InOddPlacesStayFinite) { expectPass(stability::measureDegenerateLights(contextOf({})), "default"); }

TEST_F(Lights, ExtremeValuesStayFinite) { expectPass(stability::measureExtremeValues(contextOf({})), "default"); }

TEST_F(Lights, FacingMirrorsAreExact) { expectPass(stability::measureCorridor(contextOf({}, true)), "default"); }

TEST_F(Lights, ClearGlassMakesNoLight) { expectPass(stability::measureGlass(contextOf({})), "default"); }

TEST_F(Lights, NearlySpecularIsSpecular) { expectPass(stability::measureNearlySpecular(contextOf({})), "default"); }

TEST_F(Lights, ManyAreAsBrightAsOne) { expectPass(stability::measureManyLights(contextOf({})), "default"); }

TEST_F(Lights, ImagesAreTheSameAgain) { expectPass(stability::measureDeterminism(contextOf({})), "default"); }

}  // namespace
}  // namespace raylab::support
