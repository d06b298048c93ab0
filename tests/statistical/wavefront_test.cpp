#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/core/error.h"
#include "engine/render/camera.h"
#include "engine/render/lighting.h"
#include "engine/render/wavefront.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"
#include "tests/support/trace_choice.h"

/// Path tracing by queues, against one kernel that follows each path to its end: the same numbers in the same order, so
/// the same bits; and against a closed form.
namespace raylab::support {
namespace {

class WavefrontTest : public GpuTest {
protected:
    /// An image whose sides are no multiples of a tile's.
    static RenderSettings oddImage(RenderSettings settings = {}) {
        const RenderSettings small = smallImage(8, 5, 6);
        settings.width = 37;
        settings.height = 21;
        settings.spp = small.spp;
        settings.depth = small.depth;
        settings.seed = small.seed;
        return settings;
    }

    /// Drivers that fuse products and sums may round in one kernel what they do not in another; a CPU's does not.
    void expectSameBits(const FilmImage& a, const FilmImage& b, const std::string& what) const {
        EXPECT_GT(estimateOf(a).mean, 0.0) << what << ": all is black";
        EXPECT_EQ(a.nonFinitePixels + b.nonFinitePixels, 0u) << what;
        EXPECT_EQ(a.samples.pixels, b.samples.pixels) << what;
        if (device_.description().kind != "cpu") {
            EXPECT_LE(countDifferent(a.mean, b.mean, 1e-3f), a.mean.pixels.size() / 50) << what;
            return;
        }
        EXPECT_EQ(countDifferent(a.mean, b.mean, 0.0f), 0u) << what;
        EXPECT_EQ(a.variance.pixels, b.variance.pixels) << what;
        EXPECT_EQ(a.rays, b.rays) << what;
    }

    void expectAsOneKernel(const Scene& scene, RenderSettings settings, const std::string& what) {
        settings.schedule = "mega";
        const FilmImage mega = renderFilm(device_, scene, settings);
        settings.schedule = "wavefront";
        expectSameBits(mega, renderFilm(device_, scene, settings), what);
    }
};

/// Lambertian surfaces and a lamp, no more.
Scene plainScene() {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.6f)), 3.0f));
    addMesh(scene, box(addMaterial(scene, lambert({0.8f, 0.3f, 0.2f})), {-0.5f, 0.0f, -0.5f}, {0.5f, 1.0f, 0.5f}));
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(5.0f)), 0.6f, 2.5f));
    lookAt(scene, {2.0f, 1.8f, 3.0f}, {0.0f, 0.4f, 0.0f}, 0.8f);
    return scene;
}

Texture halfBlended() {
    Texture texture;
    texture.width = texture.height = 8;
    texture.srgb = true;
    for (uint32_t i = 0; i < 64; ++i) texture.texels.push_back(((i + i / 8) & 1) != 0 ? 0x80e0c0a0u : 0xf0304060u);
    return texture;
}

/// What a traversal is asked in most scenes: blended alpha, and instances in two levels where they are kept.
Scene fencedScene() {
    Scene scene = plainScene();
    scene.textures = {halfBlended()};
    Material fence = lambert(0.7f);
    fence.baseColorTexture = 0;
    fence.alphaMode = AlphaMode::blend;
    addMesh(scene, quad(addMaterial(scene, fence), {-2, 0, -1}, {2, 0, -1}, {2, 2, -1}, {-2, 2, -1}));
    const uint32_t ball =
        addMesh(scene, meshOf(accel_test::sphere(0.5f, 8, 16, glm::vec3(0.0f)), addMaterial(scene, lambert(0.5f))),
                glm::translate(glm::mat4(1.0f), {-1.2f, 0.6f, 0.0f}));
    addInstance(scene, ball, glm::scale(glm::translate(glm::mat4(1.0f), {1.3f, 0.6f, 0.0f}), {-1.0f, 1.5f, 0.8f}));
    return scene;
}

/// What paths carry in most scenes: besides, smooth metal, glass that light fades in, a point and a sphere that shine,
/// a sky.
Scene variousScene() {
    Scene scene = fencedScene();
    Material metal;
    metal.metallic = 1.0f;
    metal.roughness = 0.3f;
    addMesh(scene, box(addMaterial(scene, metal), {-1.9f, 0.1f, 0.5f}, {-1.2f, 0.8f, 1.2f}));
    Material green = glass();
    green.attenuationColor = {0.3f, 0.8f, 0.4f};
    green.attenuationDistance = 0.5f;
    addMesh(scene, box(addMaterial(scene, green), {-0.4f, 0.1f, 0.8f}, {0.4f, 1.2f, 1.6f}));
    Light point, sphere;
    point.position = {1.5f, 2.2f, 1.0f};
    sphere.kind = LightKind::sphere;
    sphere.position = {-1.5f, 2.0f, 1.0f};
    sphere.radius = 0.2f;
    scene.lights = {point, sphere};
    scene.environment = constantEnvironment(0.3f);
    return scene;
}

/// Boxes of glass and water that overlap, and whose boundaries within each other are passed unseen.
Scene nestedScene() {
    Scene scene = plainScene();
    Material outer = glass(1.5f), inner = glass(1.33f);
    outer.priority = 2;
    inner.priority = 1;
    inner.attenuationColor = {0.2f, 0.5f, 0.9f};
    inner.attenuationDistance = 0.4f;
    addMesh(scene, box(addMaterial(scene, outer), {-1.0f, 0.1f, 0.8f}, {1.0f, 0.8f, 1.4f}));
    addMesh(scene, box(addMaterial(scene, inner), {-0.8f, 0.3f, 1.0f}, {0.8f, 1.2f, 1.8f}));
    return scene;
}

TEST_F(WavefrontTest, AFilmHasTheBitsOfOneKernel) {
    RenderSettings settings = oddImage();
    expectAsOneKernel(plainScene(), settings, "plain");
    expectAsOneKernel(nestedScene(), settings, "nested");
    settings.lightChoice = "tree";
    expectAsOneKernel(variousScene(), settings, "various, with a tree over lights");
}

TEST_F(WavefrontTest, OverEveryTracerAndLayout) {
    std::vector<RenderSettings> choices = everyLayout();
    for (const RenderSettings& settings : everyTracer(device_.description()))
        if (settings.tracer != "software" && settings.trees == "merged") choices.push_back(settings);
    for (const RenderSettings& choice : choices) expectAsOneKernel(plainScene(), oddImage(choice), nameOf(choice));
    expectAsOneKernel(fencedScene(), oddImage(twoLevels({})), "two levels and blended alpha");
}

TEST_F(WavefrontTest, WhateverTheOrderOfTheQueues) {
    for (const char* order : {"material", "octant", "origin"}) {
        RenderSettings settings = oddImage();
        settings.queueOrder = order;
        expectAsOneKernel(fencedScene(), settings, order);
    }
}

/// Beyond the rounds that are recorded, paths are followed one by one.
TEST_F(WavefrontTest, PathsOutlastTheRounds) {
    Scene scene = plainScene();
    addMesh(scene, box(addMaterial(scene, lambert(0.95f)), {-4.0f, -0.1f, -4.0f}, {4.0f, 3.0f, 4.0f}));
    RenderSettings settings = oddImage();
    settings.depth = shared::kMostRounds + 14;
    settings.rouletteDepth = 1000;
    expectAsOneKernel(scene, settings, "thirty bounces");
    settings.depth = shared::kMostRounds - 1;
    expectAsOneKernel(scene, settings, "as many as are recorded");
    settings.depth = 1;
    expectAsOneKernel(scene, settings, "one");
}

/// Every kernel sees a path's own moment: that which traces, that which shades, and that which follows paths to their end.
TEST_F(WavefrontTest, PathsKeepTheirMoment) {
    Scene scene = fencedScene();
    for (const size_t moved : {1u, 4u})
        scene.instances[moved].endToWorld =
            glm::rotate(glm::translate(scene.instances[moved].objectToWorld, {0.4f, 0.1f, 0.3f}), 0.7f, glm::vec3(0, 1, 0));
    addMesh(scene, box(addMaterial(scene, lambert(0.95f)), {-4.0f, -0.1f, -4.0f}, {4.0f, 3.0f, 4.0f}));
    RenderSettings settings = oddImage();
    expectAsOneKernel(scene, settings, "what moves");
    settings.depth = shared::kMostRounds + 4;
    settings.rouletteDepth = 1000;
    expectAsOneKernel(scene, settings, "what moves, beyond the rounds");
}

TEST_F(WavefrontTest, SlicesDoNotShow) {
    RenderSettings settings = oddImage();
    settings.width = 168;  // more pixels than the queues hold
    settings.height = 120;
    settings.spp = 3;
    settings.sliceMs = 400.0;
    settings.queuePaths = 16384;
    expectAsOneKernel(plainScene(), settings, "queues smaller than the image");
    settings.width = 21;
    settings.spp = 70;
    settings.height = 13;
    settings.sliceMs = 1.0;
    expectAsOneKernel(plainScene(), settings, "slices of a millisecond");
    settings.sliceMs = 100.0;
    settings.spp = 40;
    settings.adaptive = true;
    expectAsOneKernel(plainScene(), settings, "adaptive");
}

/// A renderer that goes from one schedule to the other and back renders what a new one does.
TEST_F(WavefrontTest, AScheduleCanChange) {
    Scene scene = plainScene();
    RenderSettings settings = oddImage();
    settleEnvironment(scene, settings);
    Renderer renderer(device_, scene, settings);
    EXPECT_EQ(renderer.queueBytes(), 0u);
    const auto finish = [&](const char* schedule) {
        settings.schedule = schedule;
        renderer.restart(settings, chooseCamera(scene, settings.camera));
        while (renderer.step()) continue;
        return renderer.snapshot();
    };
    const FilmImage mega = finish("mega");
    expectSameBits(mega, finish("wavefront"), "to queues");
    EXPECT_GE(renderer.queueBytes(),
              static_cast<size_t>(settings.queuePaths) * pathBytes(renderer.prepared().kernelNeeds, false));
    expectSameBits(mega, finish("mega"), "and back");
}

/// A2: a closed box whose walls emit 1 and reflect rho, within the recorded rounds and beyond them.
TEST_F(WavefrontTest, ClosedBoxSumsTheGeometricSeries) {
    const glm::dvec3 rho(0.25, 0.5, 0.75);
    for (const int depth : {2, 20}) {
        Scene scene;
        Material wall = lambert(glm::vec3(rho));
        wall.emission = glm::vec3(1.0f);
        wall.doubleSided = true;
        addMesh(scene, box(addMaterial(scene, wall), {-1.0f, -1.5f, -2.0f}, glm::vec3(1.0f)));
        lookAt(scene, {0.2f, 0.1f, 0.3f}, {-1.0f, -0.5f, -2.0f}, 1.2f);
        RenderSettings settings = smallImage(16, 512, depth);
        settings.rouletteDepth = 1;
        settings.schedule = "wavefront";
        const glm::dvec3 exact = (1.0 - glm::pow(rho, glm::dvec3(depth + 1))) / (1.0 - rho);
        expectExact(renderFilm(device_, scene, settings), exact, "depth " + std::to_string(depth));
    }
}

TEST_F(WavefrontTest, IsForPathsAlone) {
    RenderSettings settings = oddImage();
    settings.schedule = "wavefront";
    settings.integrator = "ao";
    EXPECT_THROW(renderFilm(device_, plainScene(), settings), Error);
}

}  // namespace
}  // namespace raylab::support
