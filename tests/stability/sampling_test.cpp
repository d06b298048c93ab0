#include "tests/support/battery_test.h"

/// S31 to S34: shading normals, textures, sums of samples, random numbers.
namespace raylab::support {
namespace {

using Sampling = BatteryTest;

/// Ever smaller triangles lose ever less; nothing is gained.
TEST_F(Sampling, NormalsLoseLightByTheSizeOfTriangles) {
    const std::vector<Number> numbers = stability::measureShadingNormals(contextOf({}, true));
    expectPass(numbers, "default");
    const std::vector<glm::dvec2>& lost = numbers[0].plot->series[0].points;
    ASSERT_EQ(lost.size(), 4u);
    for (size_t i = 0; i < lost.size(); ++i) {
        std::printf("%g rings lose %g\n", lost[i].x, lost[i].y);
        EXPECT_GT(lost[i].y, 0.0);
        if (i > 0) {
            EXPECT_LT(lost[i].y, 0.75 * lost[i - 1].y);
        }
    }
    EXPECT_TRUE(numbers[0].picture);
}

/// Half of a sheet with holes is there: a sample of it is 0 or 1, with a deviation of 1 mean.
TEST_F(Sampling, FarTexturesKeepTheirMean) {
    const std::vector<Number> numbers = stability::measureFarTextures(contextOf({}));
    expectPass(numbers, "default");
    for (const Number& number : numbers) std::printf("%s: %g\n", number.what.c_str(), number.value);
    EXPECT_NEAR(numbers[3].value, 1.0, 0.08);
}

/// A plain sum in float does not pass, as its plot says.
TEST_F(Sampling, FilmKeepsSumsOfManySamples) {
    const std::vector<Number> numbers = stability::measureManySamples(contextOf({}));
    expectPass(numbers, "default");
    const stability::Plot& plot = *numbers[0].plot;
    for (size_t i = 0; i < plot.series[0].points.size(); ++i)
        std::printf("%g samples: %g, in float %g\n", plot.series[0].points[i].x, plot.series[0].points[i].y,
                    plot.series[1].points[i].y);
    EXPECT_GT(plot.series[1].points.back().y, numbers[0].limit);
}

/// Blue noise is correlated by design, and is seen to be.
TEST_F(Sampling, PixelsAndSeedsKnowNothingOfEachOther) {
    const std::vector<Number> numbers = stability::measureCorrelation(contextOf({}));
    for (const Number& number : numbers) std::printf("%s: %g\n", number.what.c_str(), number.value);
    expectPass(numbers, "default");
    EXPECT_GT(numbers[4].value, 10.0);
}

}  // namespace
}  // namespace raylab::support
