#include "tests/support/chi_squared.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "shaders/shared/frame.h"
#include "tests/shaders/routines.h"
#include "tests/support/draw_samples.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// A15: counts of 2^20 samples of each sampler and sampling routine against what the density says of each bin.
namespace raylab::support {
namespace {

using ChiSquared = GpuTest;

/// Number of calls of expectFits in this file; each test may then fail at random with probability .01 over all (Sidak).
constexpr double kTests = 33.0;

constexpr int kColumns = 32, kRows = 16;

/// Counts over a grid of bins; `place` takes a sample to the unit square.
std::vector<size_t> countBins(const std::vector<glm::vec4>& samples,
                              const std::function<glm::dvec2(glm::vec4)>& place) {
    std::vector<size_t> counts(kColumns * kRows);
    for (const glm::vec4& sample : samples) {
        const glm::dvec2 at = place(sample);
        EXPECT_TRUE(at.x > -1e-6 && at.x < 1.0 + 1e-6 && at.y > -1e-6 && at.y < 1.0 + 1e-6) << at.x << ", " << at.y;
        const int x = std::clamp(static_cast<int>(at.x * kColumns), 0, kColumns - 1);
        const int y = std::clamp(static_cast<int>(at.y * kRows), 0, kRows - 1);
        ++counts[static_cast<size_t>(y * kColumns + x)];
    }
    return counts;
}

void expectFits(const std::vector<size_t>& counts, const std::vector<double>& probabilities, const std::string& what) {
    const double p = chiSquaredTest(counts, probabilities);
    std::printf("%-24s p = %.4f\n", what.c_str(), p);
    EXPECT_GT(p, 1.0 - std::pow(1.0 - 0.01, 1.0 / kTests)) << what;
}

std::vector<double> uniformBins() { return std::vector<double>(kColumns * kRows, 1.0 / (kColumns * kRows)); }

/// Probabilities of the bins by the midpoint rule over a density on the unit square, which need not be normalised.
std::vector<double> binsOf(const std::function<double(double, double)>& density) {
    constexpr int kSteps = 24;
    std::vector<double> bins(kColumns * kRows);
    double total = 0.0;
    for (int y = 0; y < kRows * kSteps; ++y)
        for (int x = 0; x < kColumns * kSteps; ++x) {
            const double value = density((x + 0.5) / (kColumns * kSteps), (y + 0.5) / (kRows * kSteps));
            bins[static_cast<size_t>(y / kSteps * kColumns + x / kSteps)] += value;
            total += value;
        }
    for (double& bin : bins) bin /= total;
    return bins;
}

/// Azimuth and squared sine or radius of directions and points around the z axis.
glm::dvec2 azimuthAnd(double second, glm::vec4 v) {
    return {std::atan2(static_cast<double>(v.y), static_cast<double>(v.x)) / (2.0 * kPi) + 0.5, second};
}

/// The tail at its tabulated 5 % points, and a coin that is not fair.
TEST(ChiSquaredTail, HasThePublishedQuantiles) {
    EXPECT_NEAR(chiSquaredTail(3.841459, 1.0), 0.05, 1e-6);
    EXPECT_NEAR(chiSquaredTail(18.307038, 10.0), 0.05, 1e-6);
    EXPECT_NEAR(chiSquaredTail(124.342113, 100.0), 0.05, 1e-6);
    EXPECT_NEAR(chiSquaredTail(2.0, 2.0), std::exp(-1.0), 1e-12);
    EXPECT_LT(chiSquaredTest(std::vector<size_t>{5200, 4800}, std::vector<double>{0.5, 0.5}), 1e-4);
}

/// One sample of each pixel, and 256 of each of a square of 64: both pairs that are drawn. The blue-noise sampler has
/// but one mask of that size, so that more pixels give the same numbers again.
TEST_F(ChiSquared, SamplersAreUniform) {
    const char* const names[] = {"sobol", "independent", "stratified", "blue-noise"};
    for (uint32_t sampler = 0; sampler < 4; ++sampler)
        for (const uint32_t perPixel : {1u, 256u}) {
            if (sampler == shared::kSamplerBlueNoise && perPixel == 1) continue;
            DrawConfig config;
            config.sampler = sampler;
            config.samplesPerPixel = perPixel;
            config.pixelsPerRow = 64;
            config.sampleCount = perPixel == 1 ? 60 : perPixel;
            config.firstSample = perPixel == 1 ? 17 : 0;
            const std::vector<glm::vec4> samples = drawSamples(device_, config);
            const std::string what = std::string(names[sampler]) + ", " + std::to_string(perPixel) + " a pixel";
            expectFits(countBins(samples, [](glm::vec4 s) { return glm::dvec2(s.x, s.y); }), uniformBins(), what);
            expectFits(countBins(samples, [](glm::vec4 s) { return glm::dvec2(s.y, s.z); }), uniformBins(), what);
        }
}

TEST_F(ChiSquared, CosineHemisphere) {
    DrawConfig config;
    config.routine = shared::kRoutineCosine;
    const std::vector<glm::vec4> samples = drawSamples(device_, config);
    const auto place = [](glm::vec4 s) {
        return azimuthAnd(1.0 - static_cast<double>(s.z) * static_cast<double>(s.z), s);
    };
    expectFits(countBins(samples, place), uniformBins(), "cosine");
    for (size_t i = 0; i < samples.size(); i += 1000)
        EXPECT_NEAR(static_cast<double>(samples[i].w), static_cast<double>(samples[i].z) / kPi, 1e-6);
}

/// Density of visible normals over solid angle (Heitz 2014, equation 2), in double precision.
double visibleNormals(glm::dvec3 o, glm::dvec3 h, double alpha) {
    const double d = alpha / (h.z * h.z * (alpha * alpha - 1.0) + 1.0);
    const double tangent2 = (1.0 - o.z * o.z) / (o.z * o.z);
    const double g1 = 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * tangent2));
    return g1 * std::max(0.0, glm::dot(o, h)) * d * d / (kPi * o.z);
}

/// Bins of azimuth and z: the element of solid angle is dz dphi.
TEST_F(ChiSquared, GgxVisibleNormals) {
    const std::pair<float, double> cases[] = {{0.3f, 1.1}, {0.8f, 1.4}, {0.5f, 0.0}};
    for (const auto& [alpha, theta] : cases) {
        DrawConfig config;
        config.routine = shared::kRoutineGgxNormal;
        config.alpha = alpha;
        config.wo = glm::dvec3(std::sin(theta), 0.0, std::cos(theta));
        const glm::dvec3 o(config.wo);
        const auto density = [&o, a = static_cast<double>(alpha)](double x, double y) {
            const double s = std::sqrt(1.0 - y * y), phi = 2.0 * kPi * (x - 0.5);
            return visibleNormals(o, {s * std::cos(phi), s * std::sin(phi), y}, a);
        };
        const auto place = [](glm::vec4 s) { return azimuthAnd(static_cast<double>(s.z), s); };
        expectFits(countBins(drawSamples(device_, config), place), binsOf(density), "visible normals");
    }
}

/// Half of the square is the triangle; the other half is empty.
TEST_F(ChiSquared, Triangle) {
    DrawConfig config;
    config.routine = shared::kRoutineTriangle;
    const std::vector<size_t> counts = countBins(
        drawSamples(device_, config), [](glm::vec4 s) { return glm::dvec2(std::min(s.x / (1.0f - s.y), 1.0f), s.y); });
    const std::vector<double> bins = binsOf([](double, double y) { return 1.0 - y; });
    expectFits(counts, bins, "triangle");
}

TEST_F(ChiSquared, Disc) {
    DrawConfig config;
    config.routine = shared::kRoutineDisc;
    const auto place = [](glm::vec4 s) {
        return azimuthAnd(
            static_cast<double>(s.x) * static_cast<double>(s.x) + static_cast<double>(s.y) * static_cast<double>(s.y),
            s);
    };
    expectFits(countBins(drawSamples(device_, config), place), uniformBins(), "disc");
}

/// Over the square of twice the radius.
TEST_F(ChiSquared, Filters) {
    const auto blackmanHarris = [](double x) {
        return 0.35875 + 0.48829 * std::cos(kPi * x) + 0.14128 * std::cos(2 * kPi * x) +
               0.01168 * std::cos(3 * kPi * x);
    };
    const std::pair<const char*, std::function<double(double, double)>> filters[] = {
        {"box", [](double, double) { return 1.0; }},
        {"tent", [](double x, double y) { return (1.0 - std::abs(x)) * (1.0 - std::abs(y)); }},
        {"blackman-harris", [&](double x, double y) { return blackmanHarris(x) * blackmanHarris(y); }},
        {"gaussian", [](double x, double y) { return x * x + y * y < 1.0 ? std::exp(-4.5 * (x * x + y * y)) : 0.0; }}};
    for (uint32_t filter = 0; filter < 4; ++filter) {
        DrawConfig config;
        config.routine = shared::kRoutineFilter;
        config.filter = filter;
        config.filterRadius = 1.25f;
        const auto place = [](glm::vec4 s) { return (glm::dvec2(s.x, s.y) - 0.5) / 2.5 + 0.5; };
        const std::vector<double> bins =
            binsOf([&](double x, double y) { return filters[filter].second(2.0 * x - 1.0, 2.0 * y - 1.0); });
        expectFits(countBins(drawSamples(device_, config), place), bins, filters[filter].first);
    }
}

/// A map of 16 x 8 texels: the density over the map is the bilinear interpolation of luminance x sine at the texels'
/// centres (the weights of the alias table), in closed form over the quarters of the texels: 3/4 and 1/4 along each
/// axis.
TEST_F(ChiSquared, EnvironmentMap) {
    const Environment map =
        environmentOf(16, 8, [](glm::dvec3 d) { return d.x > 0.6 ? 9.0 : 0.3 + 0.2 * d.y + 0.1 * d.z; });
    const auto weight = [&](int x, int y) {
        y = std::clamp(y, 0, 7);
        return static_cast<double>(map.radiance.at((x + 16) % 16, y)[0]) * std::sin(kPi * (y + 0.5) / 8.0);
    };
    std::vector<double> bins;
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < kColumns; ++x) {
            const int x0 = x / 2, x1 = x0 + (x % 2 == 0 ? -1 : 1), y0 = y / 2, y1 = y0 + (y % 2 == 0 ? -1 : 1);
            bins.push_back(0.75 * (0.75 * weight(x0, y0) + 0.25 * weight(x1, y0)) +
                           0.25 * (0.75 * weight(x0, y1) + 0.25 * weight(x1, y1)));
        }
    double total = 0.0;
    for (const double bin : bins) total += bin;
    for (double& bin : bins) bin /= total;
    DrawConfig config;
    config.routine = shared::kRoutineEnvironment;
    config.environment = &map;
    const auto place = [](glm::vec4 s) {
        return glm::dvec2(0.5 + std::atan2(static_cast<double>(s.x), -static_cast<double>(s.z)) / (2.0 * kPi),
                          std::acos(std::clamp(static_cast<double>(s.y), -1.0, 1.0)) / kPi);
    };
    expectFits(countBins(drawSamples(device_, config), place), bins, "environment map");
}

/// Directions within a cone about `axis`, evenly over its solid angle: azimuth, and 1 - cosine, from the sine where
/// that keeps more digits, over that of the cone's edge.
void expectEvenCone(const std::vector<glm::vec4>& samples, glm::dvec3 axis, double oneMinusCosine,
                    const std::string& what) {
    axis = glm::normalize(axis);
    const glm::dvec3 x = glm::normalize(glm::cross(axis, {0.2, 0.7, -0.4})), y = glm::cross(axis, x);
    const auto place = [&](glm::vec4 s) {
        const glm::dvec3 d(s);
        const double cosine = glm::dot(d, axis);
        const glm::dvec2 aside(glm::dot(d, x), glm::dot(d, y));
        const double k = cosine > 0.5 ? glm::dot(aside, aside) / (1.0 + cosine) : 1.0 - cosine;
        return glm::dvec2(std::atan2(aside.y, aside.x) / (2.0 * kPi) + 0.5, k / oneMinusCosine * (1.0 - 1e-5));
    };
    expectFits(countBins(samples, place), uniformBins(), what);
    const double density = 1.0 / (2.0 * kPi * oneMinusCosine);
    for (size_t i = 0; i < samples.size(); i += 1000)
        EXPECT_NEAR(static_cast<double>(samples[i].w), density, 2e-5 * density) << what;
}

/// Spheres from close by and from afar, and the sun as it is seen and a hundred times as wide.
TEST_F(ChiSquared, SphereAndSunByCone) {
    DrawConfig config;
    config.routine = shared::kRoutineSphere;
    config.alpha = 0.6f;
    for (const glm::vec3 receiver : {glm::vec3(0.3f, -0.5f, 0.4f), glm::vec3(3.0f, 7.0f, -5.0f)}) {
        config.wo = receiver;
        const double sine = static_cast<double>(config.alpha) / glm::length(glm::dvec3(receiver));
        expectEvenCone(drawSamples(device_, config), -glm::dvec3(receiver),
                       sine * sine / (1.0 + std::sqrt(1.0 - sine * sine)), "sphere");
    }
    config.routine = shared::kRoutineSunDisc;
    config.wo = glm::normalize(glm::vec3(0.3f, 0.8f, -0.2f));
    for (const double half : {0.00465, 0.465}) {
        const double oneMinusCosine = 2.0 * std::sin(0.5 * half) * std::sin(0.5 * half);
        config.alpha = static_cast<float>(oneMinusCosine);
        expectEvenCone(drawSamples(device_, config), config.wo, oneMinusCosine, "sun");
    }
}

/// Solid angle of the rectangle between the origin's foot and (x, y), at height h: its closed form, signed by x and y.
double cornerAngle(double x, double y, double h) { return std::atan(x * y / (h * std::sqrt(x * x + y * y + h * h))); }

double rectangleAngle(glm::dvec2 low, glm::dvec2 high, double h) {
    return cornerAngle(high.x, high.y, h) - cornerAngle(low.x, high.y, h) - cornerAngle(high.x, low.y, h) +
           cornerAngle(low.x, low.y, h);
}

/// Each part of a rectangle lamp gets samples by its solid angle, wherever it is seen from: closely over its middle and
/// beyond an edge, from nearly within its plane, from afar. Far away the area serves, and the density is that of a
/// point.
TEST_F(ChiSquared, RectangleBySolidAngle) {
    const glm::vec3 receivers[] = {{0.4f, 0.3f, 0.2f}, {-1.0f, 0.1f, 0.7f}, {1.2f, -0.3f, 0.05f}, {3.0f, 4.0f, 5.0f}};
    for (const glm::vec3 receiver : receivers) {
        DrawConfig config;
        config.routine = shared::kRoutineRectangle;
        config.wo = receiver;
        config.alpha = 0.6f;
        const std::vector<glm::vec4> samples = drawSamples(device_, config);
        const double h = static_cast<double>(receiver.z);
        const glm::dvec2 size(1.0, static_cast<double>(config.alpha)), foot(receiver);
        const double whole = rectangleAngle(-foot, size - foot, h);
        std::vector<double> bins;
        for (int y = 0; y < kRows; ++y)
            for (int x = 0; x < kColumns; ++x) {
                const glm::dvec2 low = size * glm::dvec2(x, y) / glm::dvec2(kColumns, kRows) - foot;
                bins.push_back(rectangleAngle(low, low + size / glm::dvec2(kColumns, kRows), h) / whole);
            }
        const bool byArea = whole < 0.01;
        // A point some units away is rounded: a little towards the middle.
        const auto place = [&](glm::vec4 s) { return 0.5 + (glm::dvec2(s.x, s.y) / size - 0.5) * (1.0 - 1e-5); };
        char what[64];
        std::snprintf(what, sizeof(what), "rectangle of %.5f sr", whole);
        expectFits(countBins(samples, place), byArea ? uniformBins() : bins, what);
        for (size_t i = 0; i < samples.size(); i += 1000) {
            const glm::dvec2 to = glm::dvec2(samples[i].x, samples[i].y) - foot;
            const double r2 = glm::dot(to, to) + h * h;
            const double density = byArea ? r2 * std::sqrt(r2) / (h * size.x * size.y) : 1.0 / whole;
            EXPECT_NEAR(static_cast<double>(samples[i].z), density, 2e-4 * density) << what;
            EXPECT_NEAR(static_cast<double>(samples[i].w), density, 2e-4 * density) << what;
        }
    }
}

}  // namespace
}  // namespace raylab::support
