#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

using CameraModel = GpuTest;

/// Mean of a column over the rows.
std::vector<double> columnMeans(const Bitmap& image) {
    std::vector<double> means(static_cast<size_t>(image.width));
    for (int x = 0; x < image.width; ++x)
        for (int y = 0; y < image.height; ++y)
            means[static_cast<size_t>(x)] += static_cast<double>(image.at(x, y)[0]) / image.height;
    return means;
}

/// A12. A lens of 50 mm at f/2, in focus at 2 m; the edge of a lamp at 5 m. On the sensor each point is a disc of
/// diameter c = (f/N) |S2 - S1| / S2 f / (S1 - f) = .3846 mm. The edge's profile falls like the integral of the disc's
/// chords, whose variance is c^2 / 16.
TEST_F(CameraModel, CircleOfConfusion) {
    const double f = 0.05, number = 2.0, s1 = 2.0, s2 = 5.0, sensor = 0.001;
    const double sensorDistance = f * s1 / (s1 - f);
    const double exact = f / number * (s2 - s1) / s2 * f / (s1 - f);
    EXPECT_NEAR(exact, 0.3846e-3, 1e-7);
    Scene scene;
    addMesh(scene, quad(addMaterial(scene, lamp(1.0f)), {-1, -1, -5}, {0, -1, -5}, {0, 1, -5}, {-1, 1, -5}));
    lookAt(scene, glm::vec3(0.0f), {0.0f, 0.0f, -2.0f},
           static_cast<float>(2.0 * std::atan(0.5 * sensor / sensorDistance)));
    RenderSettings settings = smallImage(64, 1024, 0);
    settings.lensRadius = 0.5 * f / number;
    for (const double focus : {0.0, s1}) {  // 0: the camera's target
        settings.focusDistance = focus;
        const std::vector<double> edge = columnMeans(renderFilm(device_, scene, settings).mean);
        double mean = 0.0, second = 0.0;  // of -dE/dx, in pixels
        for (size_t x = 0; x < edge.size(); ++x) {
            mean += edge[x];
            second += 2.0 * (static_cast<double>(x) + 0.5) * edge[x];
        }
        const double variance = second - 1.0 / 6.0 - mean * mean;  // a column's mean stands for its slope
        const double measured = 4.0 * std::sqrt(variance) * sensor / 64.0;
        std::printf("circle of confusion %.5f mm, exactly %.5f mm\n", 1e3 * measured, 1e3 * exact);
        EXPECT_NEAR(measured, exact, 0.005 * exact);
        EXPECT_NEAR(mean, 32.0, 0.1);
    }
}

/// What lies in the plane of focus is as sharp as with a pinhole.
TEST_F(CameraModel, PlaneOfFocusIsSharp) {
    Scene scene;
    addMesh(scene, quad(addMaterial(scene, lamp(1.0f)), {-1, -1, -5}, {0, -1, -5}, {0, 1, -5}, {-1, 1, -5}));
    lookAt(scene, glm::vec3(0.0f), {0.0f, 0.0f, -2.0f}, 0.02f);
    RenderSettings settings = smallImage(16, 64, 0);
    settings.lensRadius = 0.1;
    settings.focusDistance = 5.0;
    const std::vector<double> edge = columnMeans(renderFilm(device_, scene, settings).mean);
    for (size_t x = 0; x < edge.size(); ++x) EXPECT_NEAR(edge[x], x < 8 ? 1.0 : 0.0, 2e-3) << x;
}

/// Part of a filter on [-1, 1]^2 that lies left of x, by the midpoint rule.
double partLeftOf(double x, const std::function<double(double, double)>& filter) {
    constexpr int kSteps = 400;
    double part = 0.0, all = 0.0;
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
            const double px = 2.0 * (i + 0.5) / kSteps - 1.0, py = 2.0 * (j + 0.5) / kSteps - 1.0;
            const double value = filter(px, py);
            all += value;
            if (px < x) part += value;
        }
    return part / all;
}

/// A lamp fills the left half of the image: a pixel is the part of its filter that lies there.
TEST_F(CameraModel, FiltersWeighTheImage) {
    const auto window = [](double x) {
        return 0.35875 + 0.48829 * std::cos(kPi * x) + 0.14128 * std::cos(2 * kPi * x) +
               0.01168 * std::cos(3 * kPi * x);
    };
    const std::pair<const char*, std::function<double(double, double)>> filters[] = {
        {"box", [](double, double) { return 1.0; }},
        {"tent", [](double x, double y) { return (1.0 - std::abs(x)) * (1.0 - std::abs(y)); }},
        {"blackman-harris", [&](double x, double y) { return window(x) * window(y); }},
        {"gaussian", [](double x, double y) { return x * x + y * y < 1.0 ? std::exp(-4.5 * (x * x + y * y)) : 0.0; }}};
    Scene scene;
    addMesh(scene, quad(addMaterial(scene, lamp(1.0f)), {-3, 0, 3}, {0, 0, 3}, {0, 0, -3}, {-3, 0, -3}));
    lookDown(scene, 0.5f);
    for (const auto& [name, filter] : filters) {
        RenderSettings settings = smallImage(16, 1024, 0);
        settings.filter = name;
        settings.filterRadius = 2.5;
        const std::vector<double> edge = columnMeans(renderFilm(device_, scene, settings).mean);
        double worst = 0.0;
        for (int x = 0; x < 16; ++x) {
            const double exact = partLeftOf((7.5 - x) / 2.5, filter);
            worst = std::max(worst, std::abs(edge[static_cast<size_t>(x)] - exact));
        }
        std::printf("%-16s profile of an edge: off by %.5f at most\n", name, worst);
        EXPECT_LT(worst, 0.008) << name;  // 4 standard errors of 16384 independent samples at 1/2 are .0156
    }
}

/// Beyond the clamp a sample keeps its colour, and the film knows what was cut; below, nothing happens.
TEST_F(CameraModel, ClampCountsWhatItTakes) {
    Scene scene;
    Material bright = lamp(1.0f);
    bright.emission = {8.0f, 4.0f, 2.0f};
    addMesh(scene, floorQuad(addMaterial(scene, bright), 3.0f));
    lookDown(scene, 0.5f);
    RenderSettings settings = smallImage(8, 16, 0);
    settings.clamp = 2.0;
    const FilmImage clamped = renderFilm(device_, scene, settings);
    expectEveryPixel(clamped, glm::dvec3(2.0, 1.0, 0.5), 1e-6);
    EXPECT_NEAR(clamped.clampedEnergy, 0.75, 1e-6);
    settings.clamp = 8.0;
    const FilmImage whole = renderFilm(device_, scene, settings);
    expectEveryPixel(whole, glm::dvec3(8.0, 4.0, 2.0), 1e-6);
    EXPECT_EQ(whole.clampedEnergy, 0.0);
}

}  // namespace
}  // namespace raylab::support
