#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numeric>
#include <set>

#include "engine/render/blue_noise.h"
#include "engine/render/sampling.h"
#include "tests/shaders/routines.h"
#include "tests/support/draw_samples.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

using Samplers = GpuTest;

/// Power of the mask at a frequency over what white noise of the same values has on average.
double relativePower(const std::vector<uint32_t>& ranks, int size, int fx, int fy) {
    const double mean = 0.5 * (static_cast<double>(ranks.size()) - 1.0);
    std::complex<double> sum = 0.0;
    double white = 0.0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double value = ranks[static_cast<size_t>(y * size + x)] - mean;
            sum += std::polar(value, 2.0 * kPi * (fx * x + fy * y) / size);
            white += value * value;
        }
    return std::norm(sum) / white;
}

TEST(BlueNoise, IsAPermutationWithoutLowFrequencies) {
    const int size = 64;
    const std::vector<uint32_t> ranks = makeBlueNoise(size);
    std::vector<uint32_t> sorted = ranks;
    std::ranges::sort(sorted);
    for (uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
    double low = 0.0, high = 0.0;
    int lowCount = 0, highCount = 0;
    for (int fy = 0; fy < size / 2; fy += 2)
        for (int fx = 0; fx < size / 2; fx += 2) {
            const double radius = std::hypot(fx, fy);
            if (radius > 0.0 && radius < 10.0) low += relativePower(ranks, size, fx, fy), ++lowCount;
            if (radius > 22.0 && radius < 32.0) high += relativePower(ranks, size, fx, fy), ++highCount;
        }
    std::printf("blue noise: power %.4f below a sixth of the sampling frequency, %.2f above a third\n", low / lowCount,
                high / highCount);
    EXPECT_LT(low / lowCount, 0.05);
    EXPECT_GT(high / highCount, 1.0);
}

/// Kensler's three stratifications, for products, primes and squares: every row of N, every column of m n, and where
/// all cells of the m x n grid are used, each once.
TEST_F(Samplers, StratifiedFillsItsStrata) {
    for (const uint32_t count : {1u, 2u, 7u, 16u, 60u, 64u, 101u}) {
        DrawConfig config;
        config.sampler = shared::kSamplerStratified;
        config.samplesPerPixel = config.sampleCount = count;
        config.count = count * 50;
        const std::vector<glm::vec4> samples = drawSamples(device_, config);
        const auto columns = static_cast<uint32_t>(std::sqrt(count)), rows = (count + columns - 1) / columns;
        for (uint32_t pixel = 0; pixel < 50; ++pixel) {
            std::set<int> inRow, inColumn, inCell;
            for (uint32_t i = 0; i < count; ++i) {
                const glm::dvec2 u(samples[pixel * count + i]);
                inRow.insert(static_cast<int>(u.y * count));
                inColumn.insert(static_cast<int>(u.x * columns * rows));
                inCell.insert(static_cast<int>(u.x * columns) + 1000 * static_cast<int>(u.y * rows));
            }
            EXPECT_EQ(inRow.size(), count);
            EXPECT_EQ(inColumn.size(), count);
            if (columns * rows == count) {
                EXPECT_EQ(inCell.size(), count);
            }
        }
    }
}

/// A lamp above a plane, and a screen between them: edges of shadows, an integral over four dimensions or so.
Scene shadowScene() {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.6f)), 3.0f));
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(3.0f)), 0.5f, 1.5f));
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.2f)), 0.3f, 0.9f));
    lookDown(scene, 0.5f);
    return scene;
}

double rmse(const Bitmap& a, const Bitmap& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.pixels.size(); ++i) sum += std::pow(static_cast<double>(a.pixels[i] - b.pixels[i]), 2.0);
    return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

/// S18: root mean square error over samples on log-log axes. Independent samples have the slope -1/2; the others are as
/// steep or steeper, and never worse. The reference has 32 times the samples at least.
TEST_F(Samplers, ErrorFallsWithSamples) {
    const Scene scene = shadowScene();
    const auto render = [&](const std::string& sampler, int64_t spp, int64_t seed) {
        RenderSettings settings = smallImage(24, spp, 1);
        settings.sampler = sampler;
        settings.seed = seed;
        return renderFilm(device_, scene, settings).mean;
    };
    const Bitmap reference = render("sobol", 8192, 99);
    double independentLast = 0.0;
    for (const std::string sampler : {"independent", "sobol", "stratified", "blue-noise"}) {
        double slope = 0.0, last = 0.0;
        const int64_t counts[] = {4, 16, 64, 256};
        std::string row;
        for (int i = 0; i < 4; ++i) {
            double square = 0.0;
            for (const int64_t seed : {1, 2, 3})
                square += std::pow(rmse(render(sampler, counts[i], seed), reference), 2.0) / 3.0;
            last = std::sqrt(square);
            slope += (i - 1.5) * std::log(last) / (5.0 * std::log(4.0));  // least squares over four points
            row += "  " + std::to_string(last);
        }
        std::printf("%-12s slope %.3f  RMSE at 4, 16, 64, 256:%s\n", sampler.c_str(), slope, row.c_str());
        if (sampler == "independent") {
            EXPECT_NEAR(slope, -0.5, 0.05);
            independentLast = last;
        }
        EXPECT_LT(slope, -0.45) << sampler;
        EXPECT_LE(last, 1.05 * independentLast) << sampler;
    }
}

/// Every sampler and filter gives the same picture of something without edges: a lamp of one radiance beyond the
/// image's borders.
TEST_F(Samplers, AgreeOnTheMean) {
    for (const std::string& sampler : samplerNames())
        for (const std::string& filter : filterNames()) {
            Scene scene;
            addMesh(scene, floorQuad(addMaterial(scene, lambert(0.6f)), 3.0f));
            addMesh(scene, ceilingQuad(addMaterial(scene, lamp(3.0f)), 0.5f, 1.0f));
            lookAtPoint(scene, {3.0f, 0.4f, 1.0f}, glm::vec3(0.0f));
            RenderSettings settings = smallImage(8, 1024, 1);
            settings.sampler = sampler;
            settings.filter = filter;
            expectExact(renderFilm(device_, scene, settings), 0.6 / kPi * 0.752275 * 3.0, sampler + ", " + filter);
        }
}

TEST(StratifiedSampler, RefusesMoreThanItCounts) {
    RenderSettings settings;
    settings.sampler = "stratified";
    settings.spp = (int64_t{1} << 24) + 1;
    shared::FrameParams frame{};
    EXPECT_THROW(writeSampling(settings, frame), std::exception);
}

}  // namespace
}  // namespace raylab::support
