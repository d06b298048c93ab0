#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/luminance.h"
#include "ui/editor/model/color_temperature.h"

namespace raylab::editor {
namespace {

/// Points of the Planckian locus for the CIE 1931 observer: illuminant A (2855.5 K; CIE 15) and G. Wyszecki, W. S.
/// Stiles, "Color Science", table of chromaticities of black bodies. The fit of the observer is good to about 0.003 of
/// them.
TEST(ColorTemperature, LiesOnThePlanckianLocus) {
    struct Point {
        double kelvin, x, y;
    };
    for (const Point& p : {Point{2000, 0.5267, 0.4133}, Point{2855.5, 0.44757, 0.40745}, Point{4000, 0.3805, 0.3768},
                           Point{6500, 0.3135, 0.3237}, Point{10000, 0.2807, 0.2884}}) {
        const glm::dvec2 xy = blackbodyChromaticity(p.kelvin);
        EXPECT_NEAR(xy.x, p.x, 0.005) << p.kelvin;
        EXPECT_NEAR(xy.y, p.y, 0.005) << p.kelvin;
    }
}

/// The observer's own numbers at the peaks of its lobes (CIE 1931, 1 nm table).
TEST(ColorTemperature, ObserverIsNearTheTable) {
    EXPECT_NEAR(colorMatching(555.0).y, 1.0000, 0.02);
    EXPECT_NEAR(colorMatching(600.0).x, 1.0622, 0.03);
    EXPECT_NEAR(colorMatching(445.0).z, 1.7826, 0.05);
    EXPECT_NEAR(colorMatching(700.0).y, 0.0041, 0.005);
}

TEST(ColorTemperature, ColoursHaveLuminanceOneAndGoFromRedToBlue) {
    double ratio = std::numeric_limits<double>::infinity();
    for (const double kelvin : {1000.0, 1800.0, 2700.0, 4000.0, 6500.0, 12000.0, 40000.0}) {
        const glm::vec3 color = blackbodyColor(kelvin);
        EXPECT_NEAR(luminance(color), 1.0f, 1e-5f) << kelvin;
        EXPECT_TRUE(color.x >= 0.0f && color.y >= 0.0f && color.z >= 0.0f) << kelvin;
        const double redToBlue = static_cast<double>(color.x) / std::max(static_cast<double>(color.z), 1e-9);
        EXPECT_LE(redToBlue, ratio) << kelvin;
        ratio = redToBlue;
    }
    const glm::vec3 daylight = blackbodyColor(6600.0);
    EXPECT_NEAR(daylight.x, daylight.z, 0.12f);  // near the white of sRGB, D65
    EXPECT_EQ(blackbodyColor(10.0), blackbodyColor(kLowestKelvin));
}

}  // namespace
}  // namespace raylab::editor
