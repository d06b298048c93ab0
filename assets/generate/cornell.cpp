#include "assets/generate/cornell.h"

#include <array>

#include "assets/generate/scene_tools.h"
#include "assets/generate/spectra.h"

namespace raylab::assets {
namespace {

// Measured reflectances and emission, from the Cornell Box Data page. Reflectances: the published 4 nm samples,
// weighted 1:2:1 into one value every 8 nm, which moves no colour below by more than 0.0015.
constexpr float kLightValues[] = {0.0f, 8.0f, 15.6f, 18.4f};
constexpr float kLightReflectance = 0.78f;
constexpr float kWhiteValues[] = {0.377f, 0.543f, 0.660f, 0.706f, 0.716f, 0.740f, 0.751f, 0.772f, 0.753f, 0.743f,
                                  0.744f, 0.753f, 0.747f, 0.737f, 0.736f, 0.726f, 0.728f, 0.733f, 0.745f, 0.730f,
                                  0.727f, 0.723f, 0.753f, 0.751f, 0.736f, 0.738f, 0.744f, 0.750f, 0.735f, 0.738f,
                                  0.716f, 0.724f, 0.723f, 0.711f, 0.747f, 0.750f, 0.729f, 0.737f};
constexpr float kRedValues[] = {0.042f, 0.049f, 0.050f, 0.053f, 0.056f, 0.058f, 0.060f, 0.061f, 0.062f, 0.061f,
                                0.060f, 0.058f, 0.058f, 0.056f, 0.057f, 0.057f, 0.058f, 0.058f, 0.060f, 0.062f,
                                0.066f, 0.073f, 0.090f, 0.125f, 0.198f, 0.294f, 0.399f, 0.483f, 0.553f, 0.607f,
                                0.619f, 0.621f, 0.637f, 0.628f, 0.627f, 0.638f, 0.648f, 0.638f};
constexpr float kGreenValues[] = {0.093f, 0.097f, 0.097f, 0.096f, 0.095f, 0.097f, 0.098f, 0.103f, 0.107f, 0.112f,
                                  0.126f, 0.162f, 0.232f, 0.340f, 0.431f, 0.471f, 0.475f, 0.449f, 0.425f, 0.375f,
                                  0.334f, 0.290f, 0.265f, 0.229f, 0.188f, 0.160f, 0.141f, 0.131f, 0.123f, 0.121f,
                                  0.115f, 0.117f, 0.118f, 0.123f, 0.133f, 0.143f, 0.149f, 0.156f};

constexpr Spectrum kLight{400.0f, 100.0f, kLightValues};

using Corners = std::array<glm::vec3, 4>;

void appendCorners(Geometry& g, const Corners& c) { appendQuad(g, c[0], c[1], c[2], c[3], {0.0f, 1.0f}, {1.0f, 0.0f}); }

constexpr Corners kLightCorners = {glm::vec3(343.0f, 548.8f, 227.0f), glm::vec3(343.0f, 548.8f, 332.0f),
                                   glm::vec3(213.0f, 548.8f, 332.0f), glm::vec3(213.0f, 548.8f, 227.0f)};

/// The published ceiling around the hole in which the light sits: four quadrilaterals between the two outlines.
Geometry ceilingAroundLight() {
    const Corners outer = {glm::vec3(556.0f, 548.8f, 0.0f), glm::vec3(556.0f, 548.8f, 559.2f),
                           glm::vec3(0.0f, 548.8f, 559.2f), glm::vec3(0.0f, 548.8f, 0.0f)};
    Geometry g;
    for (size_t i = 0; i < 4; ++i) {
        const size_t next = (i + 1) % 4;
        appendCorners(g, {outer[i], outer[next], kLightCorners[next], kLightCorners[i]});
    }
    return g;
}

/// A block open at the bottom, as published: top and four sides. `top` is counter-clockwise seen from above.
Geometry block(const Corners& top) {
    Geometry g;
    appendCorners(g, top);
    for (size_t i = 0; i < 4; ++i) {
        const glm::vec3 a = top[i];
        const glm::vec3 b = top[(i + 1) % 4];
        appendCorners(g, {glm::vec3(a.x, 0.0f, a.z), glm::vec3(b.x, 0.0f, b.z), b, a});
    }
    return g;
}

Geometry quad(const Corners& corners) {
    Geometry g;
    appendCorners(g, corners);
    return g;
}

uint32_t addLambertian(Scene& scene, const std::string& name, glm::vec3 colour, glm::vec3 emission = {}) {
    Material material = plainMaterial(name, colour, 1.0f);
    material.emission = emission;
    material.specular = 0.0f;
    return addMaterial(scene, material);
}

}  // namespace

Scene makeCornellBox() {
    Scene scene;
    scene.name = "Cornell box";
    const auto colourOf = [](std::span<const float> values) {
        return reflectanceToRgb({400.0f, 8.0f, values}, kLight);
    };
    const uint32_t white = addLambertian(scene, "white", colourOf(kWhiteValues));
    const uint32_t red = addLambertian(scene, "red", colourOf(kRedValues));
    const uint32_t green = addLambertian(scene, "green", colourOf(kGreenValues));
    const uint32_t light = addLambertian(scene, "light", glm::vec3(kLightReflectance), radianceToRgb(kLight));

    const auto add = [&scene](const char* name, const Geometry& g, uint32_t material) {
        addInstance(scene, name, addMesh(scene, name, g, material));
    };
    add("floor", quad({{{552.8f, 0, 0}, {0, 0, 0}, {0, 0, 559.2f}, {549.6f, 0, 559.2f}}}), white);
    add("light", quad(kLightCorners), light);
    add("ceiling", ceilingAroundLight(), white);
    add("back wall", quad({{{549.6f, 0, 559.2f}, {0, 0, 559.2f}, {0, 548.8f, 559.2f}, {556, 548.8f, 559.2f}}}), white);
    add("right wall", quad({{{0, 0, 559.2f}, {0, 0, 0}, {0, 548.8f, 0}, {0, 548.8f, 559.2f}}}), green);
    add("left wall", quad({{{552.8f, 0, 0}, {549.6f, 0, 559.2f}, {556, 548.8f, 559.2f}, {556, 548.8f, 0}}}), red);
    add("short block", block({{{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}}}), white);
    add("tall block", block({{{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}}}), white);

    // Focal length 0.035 behind a film of 0.025 x 0.025.
    const float fovYRadians = 2.0f * std::atan(0.5f * 0.025f / 0.035f);
    addCamera(scene, "cornell", {278.0f, 273.0f, -800.0f}, {278.0f, 273.0f, 279.6f}, fovYRadians);
    return scene;
}

}  // namespace raylab::assets
