#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "engine/measure/image_error.h"
#include "engine/render/tracer.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// Motion blur of instances: in closed form, and against pictures of the same scene standing still.
namespace raylab::support {
namespace {

using InstanceMotion = GpuTest;

glm::mat4 translation(glm::vec3 by) { return glm::translate(glm::mat4(1.0f), by); }

/// A white half plane, x > 0, moves to the left below a camera that looks down: a point is white for the share of the
/// time that the edge is behind it, a linear ramp as wide as the motion. In every layout, and without a tree.
TEST_F(InstanceMotion, AMovingEdgeIsARamp) {
    constexpr double kWay = 0.4;
    constexpr int kSize = 32;
    Scene scene;
    addMesh(scene, quad(addMaterial(scene, lamp(1.0f)), {0, 0, 3}, {3, 0, 3}, {3, 0, -3}, {0, 0, -3}));
    scene.instances[0].endToWorld = translation({-kWay, 0, 0});
    lookDown(scene, 2.0f);
    for (const std::string layout : {"bvh2", "bvh2q", "bvh4b", "bvh4q", "bvh8q", "brute"})
        for (const double shutter : {1.0, 0.5}) {
            RenderSettings settings = smallImage(kSize, 64, 1);
            settings.antialias = "1";
            settings.shutter = shutter;
            settings.tracer = layout == "brute" ? layout : "software";
            if (layout != "brute") settings.layout = layout;
            const FilmImage film = renderFilm(device_, scene, settings);
            double worst = 0.0;
            for (int x = 0; x < kSize; ++x) {
                const double place = (x + 0.5) / kSize - 0.5;
                const double exact = std::clamp((place + kWay * shutter) / (kWay * shutter), 0.0, 1.0);
                for (int y = 0; y < kSize; y += 5)
                    worst = std::max(worst, std::abs(static_cast<double>(film.mean.at(x, y)[0]) - exact));
            }
            EXPECT_LE(worst, 2.0 / 64.0) << layout << ", shutter " << shutter;
        }
}

Mesh smoothBall(uint32_t material) {
    Mesh mesh = meshOf(accel_test::sphere(0.5f, 8, 12, glm::vec3(0.0f)), material);
    for (const glm::vec3& p : mesh.positions) mesh.normals.push_back(glm::normalize(p));
    return mesh;
}

/// A ball with normals that is stretched and turned on its way, a box that turns, a quadric, a floor that stands still.
Scene movingScene() {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert({0.7f, 0.6f, 0.5f})), 4.0f));
    addMesh(scene, smoothBall(addMaterial(scene, lambert({0.8f, 0.2f, 0.2f}))), translation({-1.0f, 0.7f, 0.3f}));
    scene.instances[1].endToWorld = glm::rotate(glm::scale(translation({-0.2f, 0.9f, 0.5f}), {1.5f, 0.7f, 1.0f}), 0.5f,
                                                glm::vec3(0.0f, 0.0f, 1.0f));
    addMesh(scene, box(addMaterial(scene, lambert({0.2f, 0.3f, 0.8f})), glm::vec3(-0.3f), glm::vec3(0.3f)),
            translation({0.8f, 0.4f, -0.3f}));
    scene.instances[2].endToWorld =
        glm::rotate(translation({0.9f, 0.5f, 0.1f}), 0.9f, glm::normalize(glm::vec3(0.2f, 1.0f, 0.3f)));
    Mesh quadric;
    quadric.material = addMaterial(scene, lambert({0.3f, 0.8f, 0.3f}));
    quadric.quadrics.push_back({QuadricKind::ellipsoid, {0.3f, 0.4f, 0.3f}, -1.0f, 1.0f});
    addMesh(scene, std::move(quadric), translation({0.1f, 0.5f, -1.0f}));
    scene.instances[3].endToWorld = glm::rotate(translation({0.3f, 0.4f, -0.8f}), 0.7f, glm::vec3(1.0f, 0.0f, 0.0f));
    Light light;
    light.kind = LightKind::sphere;
    light.position = {1.5f, 3.0f, 2.0f};
    light.radius = 0.4f;
    light.intensity = glm::vec3(8.0f);
    scene.lights = {light};
    scene.environment = constantEnvironment(0.4f);
    lookAt(scene, {0.3f, 1.6f, 4.0f}, {0.0f, 0.5f, -0.1f}, 0.7f);
    return scene;
}

Scene standingAt(Scene scene, double time) {
    for (Instance& instance : scene.instances) {
        if (instance.endToWorld)
            instance.objectToWorld =
                glm::mat4(glm::dmat4(instance.objectToWorld) * (1.0 - time) + glm::dmat4(*instance.endToWorld) * time);
        instance.endToWorld.reset();
    }
    return scene;
}

/// Mean of pictures at moments that are stratified over the time, and the variance of that mean from differences of
/// neighbouring ones, which is never too small.
struct Stills {
    Bitmap mean, varianceOfMean;
};

Stills averageStills(Device& device, const Scene& scene, const RenderSettings& settings, int count) {
    std::mt19937 random(20250302);
    std::vector<Bitmap> pictures;
    for (int k = 0; k < count; ++k) {
        RenderSettings still = settings;
        still.seed = 1000 + k;
        const double time = (k + std::uniform_real_distribution<double>(0.0, 1.0)(random)) / count;
        pictures.push_back(renderFilm(device, standingAt(scene, time), still).mean);
    }
    Stills stills{pictures[0], pictures[0]};
    for (size_t i = 0; i < stills.mean.pixels.size(); ++i) {
        double sum = 0.0, squares = 0.0;
        for (size_t k = 0; k < pictures.size(); ++k) {
            sum += static_cast<double>(pictures[k].pixels[i]);
            if (k > 0) squares += std::pow(static_cast<double>(pictures[k].pixels[i] - pictures[k - 1].pixels[i]), 2);
        }
        stills.mean.pixels[i] = static_cast<float>(sum / count);
        stills.varianceOfMean.pixels[i] = static_cast<float>(0.5 * squares / (count - 1.0) / count);
    }
    return stills;
}

/// Every pixel by Z-test, and the whole picture to 4 standard errors. Bodies, shadows and shading that move all count.
TEST_F(InstanceMotion, IsTheMeanOfStillsOverTime) {
    const Scene scene = movingScene();
    const Stills stills = averageStills(device_, scene, smallImage(16, 96, 3), 24);
    for (const std::string layout : {"bvh4b", "bvh2q"}) {
        RenderSettings settings = smallImage(16, 1024, 3);
        settings.layout = layout;
        const FilmImage film = renderFilm(device_, scene, settings);
        Bitmap variance = film.variance;
        double difference = 0.0, total = 0.0, ofMean = 0.0;
        for (size_t i = 0; i < variance.pixels.size(); ++i) {
            variance.pixels[i] /= film.samples.pixels[i / 3];
            difference += static_cast<double>(film.mean.pixels[i] - stills.mean.pixels[i]);
            total += static_cast<double>(stills.mean.pixels[i]);
            ofMean += static_cast<double>(variance.pixels[i] + stills.varianceOfMean.pixels[i]);
        }
        const ZTest test = zTest(film.mean, variance, stills.mean, stills.varianceOfMean);
        const auto n = static_cast<double>(variance.pixels.size());
        std::printf("%s: %.4f of %zu pixels within %.2f standard errors; mean %.5f, off by %+.6f +- %.6f\n",
                    layout.c_str(), test.passFraction, test.pixels, test.threshold, total / n, difference / n,
                    std::sqrt(ofMean) / n);
        EXPECT_GE(test.passFraction, 0.99) << layout;
        EXPECT_LE(std::abs(difference), 4.0 * std::sqrt(ofMean)) << layout;
        EXPECT_LE(std::abs(difference), 0.005 * total) << layout;
        EXPECT_EQ(film.nonFinitePixels, 0u);
    }
    // The test can tell: the scene standing still is another picture.
    const FilmImage still = renderFilm(device_, standingAt(scene, 0.0), smallImage(16, 256, 3));
    EXPECT_LE(zTest(still.mean, stills.varianceOfMean, stills.mean, stills.varianceOfMean).passFraction, 0.9);
}

/// A unit square that emits moves one unit along x above a point, one unit high: E = L times the integral over the
/// square and the time of h^2 / r^4. No light sample finds it, scattered rays do.
TEST_F(InstanceMotion, AMovingLampLights) {
    constexpr int kSteps = 120;
    double form = 0.0;
    for (int t = 0; t < kSteps; ++t)
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const double x = (i + t + 1.0) / kSteps - 1.0, z = (j + 0.5) / kSteps - 0.5;
                form += 1.0 / std::pow(1.0 + x * x + z * z, 2) / (1.0 * kSteps * kSteps * kSteps);
            }
    for (const std::string choice : {"power", "tree", "alone"}) {
        Scene scene;
        addMesh(scene, floorQuad(addMaterial(scene, lambert(0.6f)), 3.0f));
        addMesh(scene, ceilingQuad(addMaterial(scene, lamp(3.0f)), 0.5f, 0.0f), translation({-0.5f, 1.0f, 0.0f}));
        scene.instances[1].endToWorld = translation({0.5f, 1.0f, 0.0f});
        // Lamps that stand still, and give nothing here: the tree has what to choose from.
        for (const float y : {-1.0f, -2.0f})
            if (choice != "alone") addMesh(scene, ceilingQuad(addMaterial(scene, lamp(1.0f)), 0.1f, y));
        lookAtPoint(scene, {3.0f, 0.4f, 1.0f}, glm::vec3(0.0f));
        RenderSettings settings = smallImage(16, 4096, 1);
        if (choice != "alone") settings.lightChoice = choice;
        expectExact(renderFilm(device_, scene, settings), 0.6 / kPi * 3.0 * form, choice);
    }
}

/// The driver's structures stand still: the software tracer takes over.
TEST_F(InstanceMotion, HardwareTracersGiveWay) {
    const RenderSettings settings = smallImage(16, 16, 2);
    const FilmImage software = renderFilm(device_, movingScene(), settings);
    for (const char* const tracer : {"query", "pipeline"}) {
        if (!missingForTracer(tracer, device_.description()).empty()) continue;
        RenderSettings hardware = settings;
        hardware.tracer = tracer;
        EXPECT_EQ(renderFilm(device_, movingScene(), hardware).mean.pixels, software.mean.pixels) << tracer;
    }
}

}  // namespace
}  // namespace raylab::support
