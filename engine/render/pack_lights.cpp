#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/image/srgb.h"
#include "engine/render/gpu_data.h"

namespace raylab {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// Part of the light samples that goes to the kinds of light evenly, whatever their estimated power: it bounds the
/// variance where the estimate is wrong for a part of the scene.
constexpr double kEvenShare = 0.2;

double luminance(glm::vec3 c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

/// The mean of an emission texture over the whole of it (its smallest level), 1 without one.
glm::vec3 meanEmission(const Material& material, const MaterialTables& tables) {
    if (material.emissionTexture == kNoTexture) return material.emission;
    const auto index = static_cast<size_t>(material.emissionTexture);
    const bool isLast = index + 1 == tables.textures.size();
    const uint32_t texel = tables.texels[(isLast ? tables.texels.size() : tables.textures[index + 1].firstTexel) - 1];
    glm::vec3 mean;
    // One step is added lest a nearly black texture never be chosen although it emits somewhere.
    for (int i = 0; i < 3; ++i) mean[i] = srgbToLinear(static_cast<float>((texel >> (8 * i) & 255u) + 1u) / 256.0f);
    return material.emission * mean;
}

/// Weights of the materials by the luminance that they emit, or 1 for each that emits. Returns that luminance; empty where
/// none emits.
std::vector<float> weighMaterials(const Scene& scene, MaterialTables& tables, LightChoice choice) {
    std::vector<float> emitted;
    bool any = false;
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const glm::vec3 mean = meanEmission(scene.materials[i], tables);
        emitted.push_back(static_cast<float>(luminance(mean)));
        const bool emits = emitted.back() > 0.0f;
        tables.materials[i].emissionWeight = emits && choice == LightChoice::uniform ? 1.0f : emitted.back();
        any = any || emits;
    }
    return any ? emitted : std::vector<float>();
}

struct EmissiveSum {
    std::vector<double> weights;
    double flux = 0.0;
};

/// The triangles of an instance whose material has `weight` and emits the luminance `emitted`.
void appendEmissive(const Scene& scene, uint32_t instanceIndex, float weight, float emitted, LightTables& lights,
                    EmissiveSum& sum) {
    const Instance& instance = scene.instances[instanceIndex];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dmat4 matrix(instance.objectToWorld);
    const bool mirrored = glm::determinant(glm::dmat3(matrix)) < 0.0;
    const auto world = [&](uint32_t vertex) { return glm::dvec3(matrix * glm::dvec4(mesh.positions[vertex], 1.0)); };
    for (uint32_t primitive = 0; primitive < mesh.triangles.size(); ++primitive) {
        const glm::uvec3 t = mesh.triangles[primitive];
        const glm::dvec3 p0 = world(t.x), e1 = world(t.y) - p0, e2 = world(t.z) - p0;
        const double area = 0.5 * glm::length(glm::cross(e1, e2));
        if (!(area > 0.0) || !std::isfinite(area)) continue;
        shared::EmissiveData data{};
        data.p0 = glm::vec3(p0);
        data.edge1 = glm::vec3(e1);
        data.edge2 = glm::vec3(e2);
        data.material = mesh.material;
        data.instance = instanceIndex;
        data.primitive = primitive;
        data.frontSign = mirrored ? -1.0f : 1.0f;
        lights.emissive.push_back(data);
        sum.weights.push_back(area * static_cast<double>(weight));
        sum.flux += area * static_cast<double>(emitted) * kPi * (scene.materials[mesh.material].doubleSided ? 2.0 : 1.0);
    }
}

double packEmissive(const Scene& scene, MaterialTables& tables, LightChoice choice, LightTables& lights) {
    const std::vector<float> emitted = weighMaterials(scene, tables, choice);
    if (emitted.empty()) return 0.0;
    EmissiveSum sum;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const uint32_t material = scene.meshes[scene.instances[i].mesh].material;
        const float weight = tables.materials[material].emissionWeight;
        if (weight > 0.0f) appendEmissive(scene, i, weight, emitted[material], lights, sum);
    }
    const std::vector<AliasEntry> alias = buildAliasTable(sum.weights);
    for (size_t i = 0; i < alias.size(); ++i) {
        lights.emissive[i].threshold = alias[i].threshold;
        lights.emissive[i].alias = alias[i].alias;
    }
    lights.emissiveTotal = static_cast<float>(std::accumulate(sum.weights.begin(), sum.weights.end(), 0.0));
    return sum.flux;
}

double punctualFlux(const Light& light, double sceneRadius) {
    const double intensity = luminance(light.intensity);
    switch (light.kind) {
        case LightKind::point: return 4.0 * kPi * intensity;
        case LightKind::spot: return 2.0 * kPi * (1.0 - std::cos(light.outerConeRadians)) * intensity;
        case LightKind::directional: return kPi * sceneRadius * sceneRadius * intensity;
    }
    return 0.0;
}

shared::PunctualData packPunctualLight(const Light& light) {
    shared::PunctualData data{};
    data.position = light.position;
    data.direction = light.direction;
    data.intensity = light.intensity;
    data.kind = light.kind == LightKind::point         ? shared::kPunctualPoint
                : light.kind == LightKind::directional ? shared::kPunctualDirectional
                                                       : shared::kPunctualSpot;
    const float cosOuter = std::cos(light.outerConeRadians);
    data.spotScale = 1.0f / std::max(0.001f, std::cos(light.innerConeRadians) - cosOuter);
    data.spotOffset = -cosOuter * data.spotScale;
    return data;
}

double packPunctual(const Scene& scene, double sceneRadius, LightChoice choice, LightTables& lights) {
    std::vector<double> weights;
    double flux = 0.0;
    for (const Light& light : scene.lights) {
        const double ofLight = punctualFlux(light, sceneRadius);
        flux += ofLight;
        weights.push_back(choice == LightChoice::power ? ofLight : ofLight > 0.0 ? 1.0 : 0.0);
        lights.punctual.push_back(packPunctualLight(light));
    }
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const std::vector<AliasEntry> alias = buildAliasTable(weights);
    for (size_t i = 0; i < alias.size(); ++i) {
        lights.punctual[i].threshold = alias[i].threshold;
        lights.punctual[i].alias = alias[i].alias;
        lights.punctual[i].probability =
            static_cast<float>(total > 0.0 ? weights[i] / total : 1.0 / static_cast<double>(weights.size()));
    }
    return flux;
}

double packEnvironment(const Scene& scene, double sceneRadius, LightTables& lights) {
    if (!scene.environment) return 0.0;
    const Bitmap& map = scene.environment->radiance;
    if (map.pixelCount() == 1) {
        lights.environmentConstant = {map.pixels[0], map.pixels[1], map.pixels[2]};
        return 0.0;
    }
    std::vector<double> weights(map.pixelCount());
    for (int y = 0; y < map.height; ++y) {
        const double sine = std::sin(kPi * (y + 0.5) / map.height);
        for (int x = 0; x < map.width; ++x) {
            const float* p = map.at(x, y);
            weights[static_cast<size_t>(y) * map.width + x] = sine * luminance({p[0], p[1], p[2]});
        }
    }
    const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / static_cast<double>(weights.size());
    lights.environment.resize(map.pixelCount());
    for (size_t i = 0; i < weights.size(); ++i) {
        const float* p = map.pixels.data() + 3 * i;
        lights.environment[i] = {p[0], p[1], p[2], mean > 0.0 ? static_cast<float>(weights[i] / mean) : 1.0f};
    }
    lights.environmentAlias = buildAliasTable(weights);
    lights.environmentWidth = static_cast<uint32_t>(map.width);
    lights.environmentHeight = static_cast<uint32_t>(map.height);
    return kPi * sceneRadius * sceneRadius * mean * 2.0 * kPi * kPi;
}

}  // namespace

LightTables packLights(const Scene& scene, float sceneRadius, MaterialTables& materials, LightChoice choice) {
    LightTables lights;
    const double emissive = packEmissive(scene, materials, choice, lights);
    const double punctual = packPunctual(scene, sceneRadius, choice, lights);
    const double environment = packEnvironment(scene, sceneRadius, lights);
    const double kinds = (lights.emissive.empty() ? 0.0 : 1.0) + (lights.punctual.empty() ? 0.0 : 1.0) +
                         (lights.environment.empty() ? 0.0 : 1.0);
    const double total = emissive + punctual + environment;
    const auto share = [&](double flux, bool present) {
        if (!present) return 0.0f;
        const double byFlux = total > 0.0 && choice == LightChoice::power ? flux / total : 1.0 / kinds;
        return static_cast<float>((1.0 - kEvenShare) * byFlux + kEvenShare / kinds);
    };
    lights.shareEmissive = share(emissive, !lights.emissive.empty());
    lights.sharePunctual = share(punctual, !lights.punctual.empty());
    lights.shareEnvironment = share(environment, !lights.environment.empty());
    return lights;
}

}  // namespace raylab
