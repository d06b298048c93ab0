#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/measure/stability/cases.h"
#include "engine/measure/stability/render_case.h"
#include "engine/measure/stability/scene_parts.h"

namespace raylab::stability {
namespace {

/// A square of `half` around `centre`, its front along +Y, cut into 8 by 8 squares of two triangles.
Mesh tessellatedFloor(uint32_t material, float half, const glm::vec3& centre) {
    constexpr uint32_t kCells = 8;
    Mesh mesh;
    mesh.material = material;
    for (uint32_t z = 0; z <= kCells; ++z)
        for (uint32_t x = 0; x <= kCells; ++x) {
            const auto along = [half](uint32_t i) { return half * (2.0f * static_cast<float>(i) / kCells - 1.0f); };
            mesh.positions.push_back(centre + glm::vec3(along(x), 0.0f, along(z)));
        }
    for (uint32_t z = 0; z < kCells; ++z)
        for (uint32_t x = 0; x < kCells; ++x) {
            const uint32_t a = z * (kCells + 1) + x, b = a + kCells + 1;
            mesh.triangles.emplace_back(a, b, b + 1);
            mesh.triangles.emplace_back(a, b + 1, a + 1);
        }
    return mesh;
}

/// Turns +Y to a direction that is no axis, without scaling.
glm::mat4 tilt() { return glm::rotate(glm::mat4(1.0f), 0.9f, glm::normalize(glm::vec3(1.0f, 0.3f, -0.5f))); }

/// A plane that nothing stands on, lit by a sun or by a white sky alone.
struct Plane {
    Mesh mesh;
    glm::mat4 matrix{1.0f};
    glm::vec3 middle{0.0f};  ///< of the mesh
    float half = 1.0f;
    double tolerance = 1e-5;
    std::string what;
};

Scene litPlane(const Plane& plane, float sunDegrees, bool shownTwice) {
    Scene scene;
    addMaterial(scene, lambert(0.5f));
    addMesh(scene, plane.mesh, plane.matrix);
    scene.environment = constantEnvironment(1.0f);
    const double angle = glm::radians(static_cast<double>(sunDegrees));
    const glm::dvec3 towardsSun(std::sin(angle), std::cos(angle), 0.0);
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = glm::normalize(glm::vec3(-(glm::dmat3(plane.matrix) * towardsSun)));
    sun.intensity = glm::vec3(static_cast<float>(kPi));
    scene.lights = {sun};
    const glm::mat3 turn(plane.matrix);
    const glm::vec3 target(plane.matrix * glm::vec4(plane.middle, 1.0f));
    lookAt(scene, target + turn * (plane.half * glm::vec3(0.3f, 2.0f, 0.2f)), target, 0.6f);
    // Far below, so that the mesh has a tree of its own.
    if (shownTwice) addInstance(scene, 0, glm::translate(glm::mat4(1.0f), -1e3f * plane.half * turn[1]) * plane.matrix);
    return scene;
}

/// Pixels that are not exactly as bright as a plane is that never shadows itself.
Number planeNumber(const Context& context, const Plane& plane, bool shownTwice) {
    RenderSettings settings = smallImage(context.settings, 16, 2, 2);
    if (shownTwice) settings.flattenLimit = 0;
    Number number{"unevenly lit pixels: " + plane.what + (shownTwice ? ", below instances" : ""),
                  0.0,
                  0.0,
                  "pixels",
                  "of 256 in each image",
                  std::nullopt};
    for (const float sunDegrees : {30.0f, 85.0f}) {
        if (context.quick && sunDegrees < 45.0f) continue;
        const Scene scene = litPlane(plane, sunDegrees, shownTwice);
        const FilmImage film = renderFilm(context, scene, settings);
        const double exact = 0.5 + 0.5 * std::cos(glm::radians(static_cast<double>(sunDegrees)));
        judgePixels(number, scene, settings, film, exact, plane.tolerance);
    }
    return number;
}

std::string sized(const std::string& what, float size) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), " %g", static_cast<double>(size));
    return what + text.data();
}

/// Neighbours are no longer quite coplanar when they are tilted by their rounded vertices.
Number tiltedNumber(const Context& context, float half) {
    Plane plane{tessellatedFloor(0, half, glm::vec3(0.0f))};
    plane.half = half;
    for (glm::vec3& p : plane.mesh.positions) p = glm::vec3(tilt() * glm::vec4(p, 1.0f));
    Scene scene;
    addMaterial(scene, lambert(0.5f));
    addMesh(scene, plane.mesh);
    scene.environment = constantEnvironment(1.0f);
    lookAt(scene, glm::mat3(tilt()) * (half * glm::vec3(0.3f, 2.0f, 0.2f)), glm::vec3(0.0f), 0.6f);
    Number number{sized("unevenly lit pixels: tilted plane of half size", half), 0.0, 0.0, "of 256", "", std::nullopt};
    const RenderSettings settings = smallImage(context.settings, 16, 64, 2);
    judgePixels(number, scene, settings, renderFilm(context, scene, settings), 0.5, 1e-5);
    return number;
}

std::vector<Plane> planes(bool quick) {
    std::vector<Plane> result;
    const auto add = [&](float half, const glm::vec3& middle, const std::string& what) {
        result.push_back({tessellatedFloor(0, half, middle), glm::mat4(1.0f), middle, half, 1e-5, sized(what, half)});
    };
    for (const float half : {1e-3f, 1.0f, 1e3f, 1e5f})
        if (!quick || half == 1.0f) add(half, glm::vec3(0.0f), "plane of half size");
    const glm::vec3 farAway(1e4f, 1e4f, -1e4f);
    for (const float half : {1.0f, 1e3f})
        if (!quick || half == 1.0f) add(half, farAway, "at 1e4, plane of half size");
    return result;
}

std::vector<Plane> instancedPlanes() {
    std::vector<Plane> result;
    for (const auto& [scale, shift] :
         {std::pair(1.0f, glm::vec3(0.0f)), std::pair(1e3f, glm::vec3(200.0f, -500.0f, 300.0f))})
        result.push_back({tessellatedFloor(0, 1.0f, glm::vec3(0.0f)),
                          glm::scale(glm::translate(glm::mat4(1.0f), shift) * tilt(), glm::vec3(scale)),
                          glm::vec3(0.0f), 1.0f, 1e-4, sized("tilted plane, scaled by", scale)});
    return result;
}

/// Triangles as in the tests of pbrt (Pharr, Jakob, Humphreys, section 6.8): coordinates of 10^-8 to 10^8.
struct RandomTriangle {
    std::array<glm::vec3, 3> corners;
    glm::dvec3 centre, normal;
    double largest = 0.0;  ///< coordinate
    double height = 0.0;   ///< above its longest edge
};

RandomTriangle randomTriangle(Random& random) {
    RandomTriangle triangle;
    const auto coordinate = [&random] {
        const float size = std::pow(10.0f, random.uniform(-8.0f, 8.0f));
        return random.below(2) == 0 ? size : -size;
    };
    do {
        triangle.largest = 0.0;
        for (glm::vec3& corner : triangle.corners) {
            corner = {coordinate(), coordinate(), coordinate()};
            for (int i = 0; i < 3; ++i)
                triangle.largest = std::max(triangle.largest, std::abs(static_cast<double>(corner[i])));
        }
        const glm::dvec3 a(triangle.corners[0]), b(triangle.corners[1]), c(triangle.corners[2]);
        triangle.centre = (a + b + c) / 3.0;
        const glm::dvec3 across = glm::cross(b - a, c - a);
        triangle.normal = glm::normalize(across);
        triangle.height = glm::length(across) / std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    } while (!(triangle.height > 1e-3 * triangle.largest));
    return triangle;
}

Scene triangleScene(const RandomTriangle& triangle) {
    Scene scene;
    TestMesh mesh;
    mesh.add(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
    addMesh(scene, meshOf(mesh, addMaterial(scene, lambert(0.5f))));
    const glm::dvec3 eye = triangle.centre + 2.0 * triangle.height * triangle.normal;
    lookAt(scene, glm::vec3(eye), glm::vec3(triangle.centre), 0.8f);
    const glm::vec3 view = glm::vec3(triangle.normal);
    scene.cameras[0].up = std::abs(view.y) < 0.7f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return scene;
}

constexpr int64_t kAoRays = 16;

RenderSettings occlusionImage(const Context& context, int64_t size) {
    RenderSettings settings = smallImage(context.settings, size, 1, 1);
    settings.integrator = "ao";
    settings.aoRays = kAoRays;
    return settings;
}

/// Of an image by `ao` where nothing can occlude: rays that met something all the same.
double occludedRays(const FilmImage& film) {
    double occluded = 0.0;
    for (size_t i = 0; i < film.mean.pixels.size(); i += 3)
        occluded += std::round((1.0 - static_cast<double>(film.mean.pixels[i])) * kAoRays);
    return occluded;
}

/// A closed, low box below a white sky: pixels from inside that see light.
Number lowBoxNumber(const Context& context, float gap, float at) {
    Scene scene;
    const glm::vec3 lo(at), hi = lo + glm::vec3(1.0f, gap, 1.0f);
    addMesh(scene, box(addMaterial(scene, lambert(1.0f)), lo, hi));
    scene.environment = constantEnvironment(1.0f);
    const glm::vec3 eye(at + 0.5f, at + 0.5f * (hi.y - lo.y), at + 0.5f);
    lookAt(scene, eye, eye + glm::vec3(1.0f, -0.2f, 0.3f), 1.0f);
    RenderSettings settings = smallImage(context.settings, 32, context.quick ? 32 : 128, 8);
    settings.rouletteDepth = 8;
    const FilmImage film = renderFilm(context, scene, settings);
    Number number{sized(sized("lit pixels in a closed box of height", gap) + " at", at),
                  0.0,
                  0.0,
                  "of 1024",
                  std::to_string(film.rays) + " rays",
                  std::nullopt};
    judgePixels(number, scene, settings, film, 0.0, 0.0);
    return number;
}

/// Holes in a leaf must not shadow what is left of it.
Scene leafScene() {
    Scene scene;
    Texture texture;
    texture.width = texture.height = 8;
    for (uint32_t i = 0; i < 64; ++i)
        texture.texels.push_back(((i % 8) + (i / 8)) % 2 == 0 ? 0xffffffffu : 0x00ffffffu);
    scene.textures.push_back(texture);
    Material leaf = lambert(0.5f);
    leaf.alphaMode = AlphaMode::mask;
    leaf.baseColorTexture = 0;
    addMesh(scene, floorQuad(addMaterial(scene, leaf), 1.0f), tilt());
    lookAt(scene, glm::mat3(tilt()) * glm::vec3(0.3f, 1.5f, 0.2f), glm::vec3(0.0f), 1.0f);
    return scene;
}

constexpr int kTerminatorSize = 128;

/// A smooth ball of triangles below a sun from the right.
Scene terminatorScene(uint32_t rings) {
    Scene scene;
    addMesh(scene, smoothBall(addMaterial(scene, lambert(1.0f)), 1.0f, glm::vec3(0.0f), rings));
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = glm::normalize(glm::vec3(-1.0f, -0.2f, 0.0f));
    sun.intensity = glm::vec3(static_cast<float>(kPi));
    scene.lights = {sun};
    lookAt(scene, {0.0f, 0.0f, 5.0f}, glm::vec3(0.0f), 0.24f);
    return scene;
}

/// Between neighbours in a row, over the brightest pixel.
double largestStep(const FilmImage& film) {
    double largest = 0.0, step = 0.0;
    for (int y = 0; y < film.mean.height; ++y)
        for (int x = 1; x < film.mean.width; ++x) {
            const double here = static_cast<double>(*film.mean.at(x, y)),
                         before = static_cast<double>(*film.mean.at(x - 1, y));
            largest = std::max(largest, here);
            step = std::max(step, std::abs(here - before));
        }
    return step / largest;
}

/// Light through a shade so far below a lamp, as a part of the lamp's distance.
double lightThroughShade(const Context& context, float gap) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.8f)), 10.0f));
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(1e4f)), 1.0f, 100.0f));
    addMesh(scene, ceilingQuad(addMaterial(scene, lambert(0.0f)), 3.0f, 100.0f * (1.0f - gap)));
    lookAtPoint(scene, {0.0f, 5.0f, 5.0f}, glm::vec3(0.0f));
    return estimateOf(renderFilm(context, scene, smallImage(context.settings, 8, 16, 1))).mean;
}

}  // namespace

std::vector<Number> measurePlanes(const Context& context) {
    std::vector<Number> numbers;
    for (const Plane& plane : planes(context.quick)) numbers.push_back(planeNumber(context, plane, false));
    for (const float half : {1e-3f, 1.0f, 1e5f})
        if (!context.quick || half == 1.0f) numbers.push_back(tiltedNumber(context, half));
    for (const Plane& plane : instancedPlanes()) {
        if (context.quick && plane.what.find("1000") != std::string::npos) continue;
        numbers.push_back(planeNumber(context, plane, false));
        numbers.push_back(planeNumber(context, plane, true));
    }
    return numbers;
}

std::vector<Number> measureRandomTriangles(const Context& context) {
    Random random(41);
    double occluded = 0.0, rays = 0.0, triangles = 0.0;
    Number shown{"", 0.0, 0.0, "", "", std::nullopt};
    const RenderSettings settings = occlusionImage(context, context.quick ? 32 : 64);
    for (int i = 0; i < (context.quick ? 4 : 16); ++i) {
        const Scene scene = triangleScene(randomTriangle(random));
        const FilmImage film = renderFilm(context, scene, settings);
        const double here = occludedRays(film);
        occluded += here;
        triangles += here > 0.0 ? 1.0 : 0.0;
        rays += static_cast<double>(film.rays) - static_cast<double>(film.mean.pixelCount());
        judgePixels(shown, scene, settings, film, 1.0, 1e-3);
    }
    return {{"rays that hit the triangle they leave, of 10^-8 to 10^8", occluded, 0.0, "rays",
             "of " + std::to_string(static_cast<uint64_t>(rays)) + ", on " +
                 std::to_string(static_cast<int>(triangles)) + " triangles",
             std::move(shown.picture), std::move(shown.evidence)}};
}

std::vector<Number> measureLowBoxes(const Context& context) {
    std::vector<Number> numbers;
    for (const auto& [gap, at] : {std::pair(1e-4f, 1.0f), std::pair(1e-3f, 1.0f), std::pair(1e-3f, 1e3f)})
        numbers.push_back(lowBoxNumber(context, gap, at));
    return numbers;
}

std::vector<Number> measureTerminator(const Context& context) {
    const RenderSettings settings = smallImage(context.settings, kTerminatorSize, 16, 1);
    const Scene scene = terminatorScene(8);
    const FilmImage film = renderFilm(context, scene, settings);
    Number number{"largest step of brightness across the terminator of a ball of 16 x 8",
                  largestStep(film),
                  kNoLimit,
                  "of the maximum",
                  "a smooth ball has .02",
                  std::nullopt};
    showImage(number, scene, settings, film);
    PlotSeries steps{"", {{8.0, number.value}}};
    for (const uint32_t rings : {16u, 32u, 64u})
        steps.points.emplace_back(rings, largestStep(renderFilm(context, terminatorScene(rings), settings)));
    number.plot = Plot{"rings of the ball", "largest step, of the maximum", true, true, {std::move(steps)}};
    return {std::move(number)};
}

std::vector<Number> measureLeaves(const Context& context) {
    const Scene scene = leafScene();
    const RenderSettings settings = occlusionImage(context, 32);
    const FilmImage film = renderFilm(context, scene, settings);
    Number number{"rays that a leaf with holes stops on itself",
                  0.0,
                  0.0,
                  "rays",
                  "of " + std::to_string(film.rays),
                  std::nullopt};
    judgePixels(number, scene, settings, film, 1.0, 1e-3);
    number.value = occludedRays(film);
    return {std::move(number)};
}

std::vector<Number> measureScaledInstances(const Context& context) {
    std::vector<Number> numbers;
    for (const float scale : {1e-6f, 1e6f}) {
        const Plane plane{tessellatedFloor(0, 1.0f, glm::vec3(0.0f)),
                          glm::scale(tilt(), glm::vec3(scale)),
                          glm::vec3(0.0f),
                          1.0f,
                          1e-4,
                          sized("instance scaled by", scale)};
        for (const bool below : {false, true}) numbers.push_back(planeNumber(context, plane, below));
    }
    return numbers;
}

std::vector<Number> measureShades(const Context& context) {
    double leaks = 0.0;
    PlotSeries light{"", {}};
    for (const float gap : {1e-2f, 1e-3f, 2e-4f, 5e-5f, 1e-5f}) {
        light.points.emplace_back(gap, lightThroughShade(context, gap));
        if (light.points.back().y > 0.0) leaks = std::max(leaks, static_cast<double>(gap));
    }
    Number number{"a shade this close to its lamp lets light through", leaks,       1e-4, "of distance",
                  "shadow rays end 1e-4 of the way before the light",  std::nullopt};
    number.plot = Plot{"gap, of the lamp's distance", "radiance below the shade", true, false, {std::move(light)}};
    return {std::move(number)};
}

}  // namespace raylab::stability
