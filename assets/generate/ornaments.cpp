#include "assets/generate/ornaments.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace raylab::assets {
namespace {

using Outline = std::vector<glm::vec2>;

/// A thrown or blown outline.
Outline curve(const Outline& knots, int steps) { return catmullRom(knots, steps); }

glm::mat4 turned(float degrees, glm::vec3 axis) { return glm::rotate(glm::mat4(1.0f), glm::radians(degrees), axis); }

void appendRod(Geometry& g, glm::vec3 a, glm::vec3 b, float radius) {
    const glm::vec3 path[2] = {a, b};
    const float radii[2] = {radius, radius};
    append(g, tube(path, radii, 8));
}

}  // namespace

Geometry plantPot() {
    const Profile profile = {line({0.0f, 0.0f}, {0.19f, 0.0f}),
                             curve({{0.19f, 0.0f}, {0.225f, 0.12f}, {0.27f, 0.32f}, {0.295f, 0.50f}}, 6),
                             line({0.295f, 0.50f}, {0.325f, 0.515f}),
                             line({0.325f, 0.515f}, {0.332f, 0.60f}),
                             profileArc({0.318f, 0.605f}, 0.015f, 0.0f, 180.0f, 6),
                             line({0.303f, 0.605f}, {0.295f, 0.48f})};
    Geometry g = lathe(profile, 48);
    append(g, torus(0.262f, 0.012f, 0.012f, 48, 8), place({0.0f, 0.27f, 0.0f}));
    append(g, torus(0.276f, 0.009f, 0.009f, 48, 8), place({0.0f, 0.34f, 0.0f}));
    return g;
}

Geometry potEarth() { return lathe({{{0.30f, 0.535f}, {0.15f, 0.56f}, {0.0f, 0.57f}}}, 24); }

Geometry amphora() {
    const Profile profile = {line({0.0f, 0.0f}, {0.12f, 0.0f}),
                             curve({{0.12f, 0.0f},
                                    {0.125f, 0.03f},
                                    {0.11f, 0.07f},
                                    {0.20f, 0.30f},
                                    {0.265f, 0.55f},
                                    {0.25f, 0.74f},
                                    {0.15f, 0.90f},
                                    {0.095f, 0.98f},
                                    {0.09f, 1.08f},
                                    {0.13f, 1.13f}},
                                   6),
                             line({0.13f, 1.13f}, {0.13f, 1.16f}), line({0.13f, 1.16f}, {0.10f, 1.16f}),
                             curve({{0.10f, 1.16f}, {0.07f, 1.07f}, {0.07f, 0.98f}}, 4)};
    Geometry g = lathe(profile, 48);
    for (const float side : {-1.0f, 1.0f}) {
        std::vector<glm::vec3> path;
        std::vector<float> radii;
        for (int i = 0; i <= 14; ++i) {
            const float angle = glm::radians(glm::mix(100.0f, -75.0f, static_cast<float>(i) / 14.0f));
            path.emplace_back(side * (0.10f + 0.17f * std::cos(angle)), 0.915f + 0.165f * std::sin(angle), 0.0f);
            radii.push_back(0.021f);
        }
        append(g, tube(path, radii, 10));
    }
    return g;
}

Geometry glassVase() {
    const Profile profile = {
        line({0.0f, 0.0f}, {0.085f, 0.0f}),
        curve({{0.085f, 0.0f},   {0.09f, 0.012f},  {0.075f, 0.03f},  {0.105f, 0.10f},  {0.135f, 0.19f},
               {0.115f, 0.30f},  {0.062f, 0.40f},  {0.055f, 0.45f},  {0.075f, 0.50f},  {0.098f, 0.525f},
               {0.100f, 0.532f}, {0.096f, 0.534f}, {0.070f, 0.506f}, {0.049f, 0.45f},  {0.055f, 0.40f},
               {0.107f, 0.30f},  {0.127f, 0.19f},  {0.096f, 0.10f},  {0.055f, 0.055f}, {0.0f, 0.045f}},
              8)};
    return lathe(profile, 96);
}

Geometry armillary() {
    const glm::vec3 centre(0.0f, 0.53f, 0.0f);
    const glm::mat4 at = glm::translate(glm::mat4(1.0f), centre);
    const glm::vec3 xAxis(1.0f, 0.0f, 0.0f);
    const glm::vec3 zAxis(0.0f, 0.0f, 1.0f);
    const Profile stand = {line({0.0f, 0.0f}, {0.125f, 0.0f}), curve({{0.125f, 0.0f},
                                                                      {0.128f, 0.02f},
                                                                      {0.10f, 0.04f},
                                                                      {0.045f, 0.06f},
                                                                      {0.028f, 0.09f},
                                                                      {0.045f, 0.13f},
                                                                      {0.048f, 0.15f},
                                                                      {0.022f, 0.18f},
                                                                      {0.016f, 0.22f},
                                                                      {0.02f, 0.26f},
                                                                      {0.0f, 0.285f}},
                                                                     6)};
    Geometry g = lathe(stand, 48);
    const glm::mat4 tilted = at * turned(23.4f, zAxis);                                // the Earth's axis
    append(g, torus(0.250f, 0.006f, 0.016f, 128, 10), at * turned(90.0f, xAxis));      // meridian
    append(g, torus(0.265f, 0.018f, 0.005f, 128, 10), at);                             // horizon
    append(g, torus(0.232f, 0.005f, 0.013f, 128, 10), tilted);                         // equator
    append(g, torus(0.222f, 0.004f, 0.022f, 128, 10), tilted * turned(23.4f, xAxis));  // ecliptic
    append(g, torus(0.232f, 0.005f, 0.008f, 128, 10), tilted * turned(90.0f, zAxis));  // colure
    for (const float side : {-1.0f, 1.0f}) {                                           // tropics
        append(g, torus(0.213f, 0.004f, 0.006f, 128, 8), tilted * place({0.0f, side * 0.092f, 0.0f}));
    }
    append(g, sphere(0.055f, 48, 24), at);
    Geometry axis;
    appendRod(axis, {0.0f, -0.30f, 0.0f}, {0.0f, 0.30f, 0.0f}, 0.005f);
    append(axis, sphere(0.014f, 24, 12), place({0.0f, 0.30f, 0.0f}));
    append(axis, sphere(0.014f, 24, 12), place({0.0f, -0.30f, 0.0f}));
    append(g, axis, tilted);
    return g;
}

Geometry ballRest(float ballRadius) {
    const float ring = 0.5f * ballRadius;
    return torus(ring, 0.014f, 0.012f, 64, 12);
}

Geometry lanternMetal() {
    Geometry g;
    appendRod(g, {0.0f, -0.45f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.006f);
    const Profile roof = {line({0.12f, -0.60f}, {0.125f, -0.585f}), line({0.125f, -0.585f}, {0.05f, -0.51f}),
                          line({0.05f, -0.51f}, {0.04f, -0.47f}), line({0.04f, -0.47f}, {0.0f, -0.45f})};
    append(g, lathe(roof, 6));
    const Profile base = {line({0.0f, -0.92f}, {0.03f, -0.90f}), line({0.03f, -0.90f}, {0.095f, -0.875f}),
                          line({0.095f, -0.875f}, {0.095f, -0.86f}), line({0.095f, -0.86f}, {0.0f, -0.86f})};
    append(g, lathe(base, 6));
    append(g, lathe({line({0.12f, -0.60f}, {0.0f, -0.60f})}, 6));
    for (int i = 0; i < 6; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / 6.0f;
        const glm::vec3 out(std::sin(angle), 0.0f, std::cos(angle));
        appendRod(g, 0.09f * out + glm::vec3(0.0f, -0.865f, 0.0f), 0.112f * out + glm::vec3(0.0f, -0.595f, 0.0f),
                  0.006f);
    }
    return g;
}

Geometry lanternLight() {
    // Few triangles: each is a light to sample.
    return lathe({{{0.0f, -0.85f}, {0.045f, -0.82f}, {0.06f, -0.75f}, {0.045f, -0.68f}, {0.0f, -0.64f}}}, 8);
}

}  // namespace raylab::assets
