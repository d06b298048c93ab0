#include "engine/measure/image_error.h"
#include "engine/scene/import.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"

namespace raylab::support {
namespace {

using Tracers = GpuTest;

FilmImage renderCornell(Device& device, const std::string& tracer, int64_t seed) {
    RenderSettings settings = smallImage(32, 256, 6);
    settings.tracer = tracer;
    settings.seed = seed;
    const Scene scene = importScene(std::filesystem::path(RAYLAB_BINARY_DIR) / "assets/cornell.glb");
    return renderFilm(device, scene, settings);
}

Bitmap varianceOfMean(const FilmImage& film) {
    Bitmap variance = film.variance;
    for (size_t i = 0; i < variance.pixels.size(); ++i) variance.pixels[i] /= film.samples.pixels[i / 3];
    return variance;
}

/// With one seed the two follow the same paths: pixels that differ show differing hits.
TEST_F(Tracers, SoftwareEqualsBruteForceWithTheSameSeed) {
    const FilmImage software = renderCornell(device_, "software", 1), brute = renderCornell(device_, "brute", 1);
    EXPECT_LE(countDifferent(software.mean, brute.mean, 1e-5f), software.mean.pixels.size() / 1000);
    EXPECT_EQ(software.rays, brute.rays);
}

/// A17's test on two estimates of our own: 99.75 % of the pixels at a significance of 0.01, Sidak-corrected. It is
/// also a test of the film's variance: were it too small, the pixels of two seeds would differ too much.
TEST_F(Tracers, DifferentSeedsAgreeWithinTheirNoise) {
    const FilmImage software = renderCornell(device_, "software", 2), brute = renderCornell(device_, "brute", 3);
    const ZTest test = zTest(software.mean, varianceOfMean(software), brute.mean, varianceOfMean(brute));
    EXPECT_EQ(test.pixels, 1024u);
    EXPECT_GE(test.passFraction, 0.9975);
    EXPECT_NE(software.mean.pixels, brute.mean.pixels);
}

}  // namespace
}  // namespace raylab::support
