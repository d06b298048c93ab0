#include "engine/measure/unneeded.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "engine/render/camera.h"
#include "engine/render/lighting.h"
#include "engine/render/renderer.h"
#include "engine/scene/texture_slots.h"

namespace raylab {
namespace {

constexpr int kSeeds = 4;
constexpr uint32_t kSamples = 4;
constexpr double kFineTexels = 2.0;

bool emits(const Material& material) { return glm::any(glm::greaterThan(material.emission, glm::vec3(0.0f))); }

/// The scene without any light, its environment settled.
Scene darkened(const Scene& scene) {
    Scene dark = scene;
    dark.lights.clear();
    dark.environment.reset();
    dark.sky.reset();
    for (Material& material : dark.materials) material.emission = glm::vec3(0.0f);
    return dark;
}

struct LitScene {
    std::string name;
    Scene scene;
};

/// One scene a light. `settled`: with its environment.
std::vector<LitScene> scenesOfOneLight(const Scene& settled) {
    std::vector<LitScene> scenes;
    const Scene dark = darkened(settled);
    const auto nameOr = [](const std::string& name, const char* kind, size_t i) {
        return name.empty() ? std::string(kind) + " " + std::to_string(i) : name;
    };
    if (settled.environment) {
        scenes.push_back({"environment", dark});
        scenes.back().scene.environment = settled.environment;
    }
    for (size_t i = 0; i < settled.materials.size() && scenes.size() < kMostTriedLights; ++i) {
        if (!emits(settled.materials[i])) continue;
        scenes.push_back({nameOr(settled.materials[i].name, "material", i), dark});
        scenes.back().scene.materials[i].emission = settled.materials[i].emission;
    }
    for (size_t i = 0; i < settled.lights.size() && scenes.size() < kMostTriedLights; ++i) {
        scenes.push_back({nameOr(settled.lights[i].name, "light", i), dark});
        scenes.back().scene.lights = {settled.lights[i]};
    }
    return scenes;
}

double meanOfPixels(const Bitmap& bitmap) {
    return std::accumulate(bitmap.pixels.begin(), bitmap.pixels.end(), 0.0) / static_cast<double>(bitmap.pixels.size());
}

/// What of a view a triangle may be in.
struct View {
    glm::dvec3 position, right, up, forward;
    double tanHalfX, tanHalfY;
    double pixelAngle;  ///< of one pixel, at the middle of the picture

    /// All three points are on the outer side of one plane of the frustum.
    bool isOutside(const std::array<glm::dvec3, 3>& p) const {
        const auto allBeyond = [&](const auto& distance) {
            return std::ranges::all_of(p, [&](const glm::dvec3& q) { return distance(q - position) < 0.0; });
        };
        return allBeyond([&](const glm::dvec3& d) { return glm::dot(d, forward); }) ||
               allBeyond([&](const glm::dvec3& d) { return glm::dot(d, forward) * tanHalfX - glm::dot(d, right); }) ||
               allBeyond([&](const glm::dvec3& d) { return glm::dot(d, forward) * tanHalfX + glm::dot(d, right); }) ||
               allBeyond([&](const glm::dvec3& d) { return glm::dot(d, forward) * tanHalfY - glm::dot(d, up); }) ||
               allBeyond([&](const glm::dvec3& d) { return glm::dot(d, forward) * tanHalfY + glm::dot(d, up); });
    }
};

View viewOf(const Camera& camera, int64_t width, int64_t height) {
    View view;
    view.position = camera.position;
    view.forward = glm::normalize(glm::dvec3(camera.target) - view.position);
    view.right = glm::normalize(glm::cross(view.forward, glm::dvec3(camera.up)));
    view.up = glm::cross(view.right, view.forward);
    view.tanHalfY = std::tan(0.5 * static_cast<double>(camera.fovYRadians));
    view.tanHalfX = view.tanHalfY * static_cast<double>(width) / static_cast<double>(height);
    view.pixelAngle = 2.0 * view.tanHalfY / static_cast<double>(height);
    return view;
}

/// Distance from a point to a triangle, from below: to its plane or its bounding sphere, whichever is further.
double leastDistance(const glm::dvec3& point, const std::array<glm::dvec3, 3>& p) {
    const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(normal);
    const glm::dvec3 middle = (p[0] + p[1] + p[2]) / 3.0;
    double radius = 0.0;
    for (const glm::dvec3& q : p) radius = std::max(radius, glm::distance(middle, q));
    const double toPlane = length > 0.0 ? std::abs(glm::dot(point - p[0], normal)) / length : 0.0;
    return std::max(toPlane, glm::distance(middle, point) - radius);
}

/// Texture coordinates that a step of one world unit on the triangle covers, at most on average over its area.
double uvPerUnit(const std::array<glm::dvec3, 3>& p, const std::array<glm::dvec2, 3>& uv) {
    const double area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    const glm::dvec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
    return area > 0.0 ? std::sqrt(std::abs(a.x * b.y - a.y * b.x) / area) : std::numeric_limits<double>::infinity();
}

/// Lowers the least texture coordinates a pixel of each material to what an instance shows.
void visitInstance(const Scene& scene, const Instance& instance, const View& view, std::vector<double>& uvPerPixel) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.uvs.empty()) return;
    const glm::dmat4 matrix(instance.objectToWorld);
    double& least = uvPerPixel[mesh.material];
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<glm::dvec3, 3> p;
        std::array<glm::dvec2, 3> uv;
        for (int i = 0; i < 3; ++i) {
            p[i] = glm::dvec3(matrix * glm::dvec4(glm::dvec3(mesh.positions[t[i]]), 1.0));
            uv[i] = mesh.uvs[t[i]];
        }
        if (!view.isOutside(p))
            least = std::min(least, uvPerUnit(p, uv) * leastDistance(view.position, p) * view.pixelAngle);
    }
}

}  // namespace

std::optional<std::vector<LightShare>> lightShares(Device& device, const Scene& scene, const RenderSettings& settings,
                                                   const Reference& reference, const std::function<bool()>& stop) {
    Scene settled = scene;
    settleEnvironment(settled, settings);
    RenderSettings alone = settings;
    alone.spp = kSamples;
    alone.adaptive = false;
    alone.denoise = kNoDenoiser;
    const double whole = meanOfPixels(reference.image.mean);
    std::vector<LightShare> shares;
    for (const LitScene& lit : scenesOfOneLight(settled)) {
        Renderer renderer(device, lit.scene, alone);
        std::vector<double> parts;
        for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
            renderer.restart(seed, kSamples);
            while (renderer.step())
                if (stop()) return std::nullopt;
            parts.push_back(meanOfPixels(renderer.snapshot().mean) / whole);
        }
        shares.push_back({lit.name, meanInterval(parts)});
    }
    return shares;
}

std::vector<FineTexture> texturesBelowPixels(const Scene& scene, const RenderSettings& settings) {
    const View view = viewOf(chooseCamera(scene, settings.camera), settings.width, settings.height);
    constexpr double kUnseen = std::numeric_limits<double>::infinity();
    std::vector<double> uvPerPixel(scene.materials.size(), kUnseen), ofTexture(scene.textures.size(), kUnseen);
    for (const Instance& instance : scene.instances) visitInstance(scene, instance, view, uvPerPixel);
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        for (const int32_t* const texture : textureSlots(m))
            if (*texture != kNoTexture)
                ofTexture[static_cast<size_t>(*texture)] =
                    std::min(ofTexture[static_cast<size_t>(*texture)], uvPerPixel[i]);
    }
    std::vector<FineTexture> fine;
    for (size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& t = scene.textures[i];
        const double texels = ofTexture[i] * std::sqrt(static_cast<double>(t.width) * static_cast<double>(t.height));
        if (std::isfinite(texels) && texels > kFineTexels) fine.push_back({t.name, t.width, t.height, texels});
    }
    std::ranges::stable_sort(fine, std::greater{}, &FineTexture::texelsPerPixel);
    return fine;
}

}  // namespace raylab
