#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/render/tracer.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

using Ao = GpuTest;

constexpr float kLong = 2000.0f;

/// Wall of a height in the plane x = distance, facing the origin, as good as endless in z.
Mesh wallAt(uint32_t material, float distance, float height) {
    return quad(material, {distance, 0, kLong}, {distance, 0, -kLong}, {distance, height, -kLong},
                {distance, height, kLong});
}

Scene floorScene() {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.5f)), 10.0f));
    return scene;
}

FilmImage viewOrigin(Device& device, Scene scene, int64_t rays, double distance,
                     const std::string& tracer = "software") {
    lookAtPoint(scene, {-3.0f, 2.0f, 0.5f}, glm::vec3(0.0f));
    RenderSettings settings = smallImage(8, 8192 / rays, 0);
    settings.integrator = "ao";
    settings.aoRays = rays;
    settings.aoDistance = distance;
    settings.tracer = tracer;
    return renderFilm(device, std::move(scene), settings);
}

void expectOpen(const FilmImage& film, double exact, const std::string& what) {
    const Estimate estimate = estimateOf(film);
    std::printf("%-28s %.6f +- %.6f (exact %.6f)\n", what.c_str(), estimate.mean, estimate.standardError, exact);
    expectExact(film, exact, what);
}

TEST_F(Ao, NothingAboveAFloor) { expectEveryPixel(viewOrigin(device_, floorScene(), 4, 0.0), 1.0, 1e-6); }

TEST_F(Ao, WhatTheCameraMissesIsOpen) {
    Scene scene = floorScene();
    lookAt(scene, {0.0f, 1.0f, 0.0f}, {0.0f, 2.0f, 0.01f}, 0.5f);
    RenderSettings settings = smallImage(8, 4, 0);
    settings.integrator = "ao";
    expectEveryPixel(renderFilm(device_, scene, settings), 1.0, 1e-6);
}

/// A10: a wall hides half of what is between its foot and its top, by the projected solid angle.
TEST_F(Ao, WallOfAHeight) {
    for (const double height : {0.5, 1.0, 4.0}) {
        Scene scene = floorScene();
        addMesh(scene, wallAt(0, 1.0f, static_cast<float>(height)));
        const double exact = 1.0 - 0.5 * (1.0 - 1.0 / std::hypot(1.0, height));
        expectOpen(viewOrigin(device_, scene, 8, 0.0), exact, "wall of height " + std::to_string(height));
    }
}

/// A10. The wall is 1e4 times as high as it is far; the rest of it would change 5e-5.
TEST_F(Ao, FloorByAnEndlessWall) {
    Scene scene = floorScene();
    addMesh(scene, wallAt(0, 0.01f, 100.0f));
    expectOpen(viewOrigin(device_, scene, 16, 0.0), 0.5, "endless wall");
}

/// A10.
TEST_F(Ao, CornerOfThreePlanes) {
    Scene scene = floorScene();
    const float d = 0.01f, high = 200.0f;
    addMesh(scene, wallAt(0, d, high));
    addMesh(scene, quad(0, {-kLong, 0, -d}, {kLong, 0, -d}, {kLong, high, -d}, {-kLong, high, -d}));
    expectOpen(viewOrigin(device_, scene, 1, 0.0), 0.25, "corner");
}

/// Rays of length r reach an endless wall at distance d where their component towards it is above c = d / r. Projected
/// onto the floor's unit disc (Nusselt's analogue) that is a segment of area acos c - c sqrt(1 - c^2).
TEST_F(Ao, DistanceIsTheRaysLength) {
    for (const double length : {0.99, 1.25, 2.0, 8.0}) {
        Scene scene = floorScene();
        addMesh(scene, wallAt(0, 1.0f, 100.0f));
        const double c = std::min(1.0, 1.0 / length);
        const double exact = 1.0 - (std::acos(c) - c * std::sqrt(1.0 - c * c)) / kPi;
        expectOpen(viewOrigin(device_, scene, 4, length), exact, "rays of length " + std::to_string(length));
    }
}

TEST_F(Ao, SameOnEveryTracer) {
    Scene scene = floorScene();
    addMesh(scene, wallAt(0, 1.0f, 1.0f));
    const FilmImage software = viewOrigin(device_, scene, 4, 3.0);
    for (const std::string& tracer : tracerNames()) {
        if (!missingForTracer(tracer, device_.description()).empty()) continue;
        const FilmImage other = viewOrigin(device_, scene, 4, 3.0, tracer);
        EXPECT_LE(countDifferent(software.mean, other.mean, 2e-3f), 0u) << tracer;
    }
}

}  // namespace
}  // namespace raylab::support
