#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

#include "engine/core/luminance.h"
#include "engine/image/srgb.h"
#include "engine/render/gpu_data.h"
#include "engine/scene/instance_motion.h"
#include "engine/scene/needs.h"

namespace raylab {
namespace {

using std::numbers::pi;

/// Part of the light samples that goes to the kinds of light evenly, whatever their estimated power: it bounds the
/// variance where the estimate is wrong for a part of the scene.
constexpr double kEvenShare = 0.2;
/// From so many lights on a tree is worth its walk: of punctual ones that are somewhere, for what each sends falls with
/// the squared distance, and of emissive triangles and those together (docs/benchmarks/2026-11-23-sampling.md).
constexpr size_t kManyPunctual = 2, kManyLights = 32;
/// Emissive triangles whose area is this part of their box's are one lamp, which from outside sends its light as one.
constexpr double kOneLamp = 0.25;

/// The mean of an emission texture over the whole of it (its smallest level), 1 without one.
glm::vec3 meanEmission(const Material& material, const MaterialTables& tables) {
    if (material.emissionTexture == kNoTexture) return material.emission;
    const uint32_t texel = tables.means[static_cast<size_t>(material.emissionTexture)];
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
        sum.flux += area * static_cast<double>(emitted) * pi * (scene.materials[mesh.material].doubleSided ? 2.0 : 1.0);
    }
}

/// Returns the flux of all of them.
double packEmissive(const Scene& scene, const MaterialTables& tables, std::span<const float> emitted, LightTables& lights) {
    EmissiveSum sum;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const uint32_t material = scene.meshes[scene.instances[i].mesh].material;
        const float weight = tables.materials[material].emissionWeight;
        // What moves has no one place: it gives light to the rays that come upon it (lib/surface.glsl).
        if (weight > 0.0f && !moves(scene.instances[i])) appendEmissive(scene, i, weight, emitted[material], lights, sum);
    }
    const std::vector<AliasEntry> alias = buildAliasTable(sum.weights);
    for (size_t i = 0; i < alias.size(); ++i) {
        lights.emissive[i].threshold = alias[i].threshold;
        lights.emissive[i].alias = alias[i].alias;
    }
    lights.emissiveTotal = static_cast<float>(std::accumulate(sum.weights.begin(), sum.weights.end(), 0.0));
    return sum.flux;
}

bool isLocal(const Light& light) { return light.kind != LightKind::directional; }

double punctualFlux(const Light& light, double sceneRadius) {
    const double intensity = luminance(light.intensity);
    switch (light.kind) {
        case LightKind::point:
        case LightKind::sphere:
            return 4.0 * pi * intensity;
        case LightKind::spot:
            return 2.0 * pi * (1.0 - std::cos(light.outerConeRadians)) * intensity;
        case LightKind::disc:
        case LightKind::rectangle:
            return pi * intensity;
        case LightKind::directional:
            return pi * sceneRadius * sceneRadius * intensity;
    }
    return 0.0;
}

/// The scene's lights, and the sun of a computed sky where the config asks for it: shapes, other local lights, directional
/// ones, discs in the sky.
std::vector<Light> punctualLights(const Scene& scene, const LightConfig& config) {
    std::vector<Light> all = scene.lights;
    if (hasSunLight(scene, config)) {
        const SunAndSky& parts = *scene.environment->parts;
        Light sun;
        sun.kind = LightKind::directional;
        sun.direction = -parts.towardsSun;
        sun.intensity = parts.sunIrradiance;
        all.push_back(sun);
    }
    const auto rank = [](const Light& light) { return isLocal(light) ? (hasShape(light) ? 0 : 1) : (hasShape(light) ? 3 : 2); };
    std::ranges::stable_sort(all, {}, rank);
    return all;
}

/// Sums of power.
struct PunctualFlux {
    double local = 0.0;
    double directional = 0.0;
};

/// With a tree, local lights get probability 0: it chooses them.
PunctualFlux packPunctual(const std::vector<Light>& punctual, double sceneRadius, LightChoice choice, bool allPunctual, LightTables& lights) {
    std::vector<double> weights;
    PunctualFlux flux;
    for (const Light& light : punctual) {
        const double ofLight = punctualFlux(light, sceneRadius);
        (isLocal(light) ? flux.local : flux.directional) += ofLight;
        const double weight = choice != LightChoice::uniform ? ofLight : ofLight > 0.0 ? 1.0 : 0.0;
        weights.push_back(choice == LightChoice::tree && isLocal(light) ? 0.0 : weight);
        lights.punctual.push_back(allPunctual ? packAsPoint(light) : packLight(light));
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

void countShapes(const std::vector<Light>& punctual, LightTables& lights) {
    for (const Light& light : punctual)
        if (hasShape(light)) ++(isLocal(light) ? lights.shapedCount : lights.sunDiscCount);
}

bool isOneLamp(std::span<const shared::EmissiveData> emissive) {
    double area = 0.0;
    glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi = -lo;
    for (const shared::EmissiveData& triangle : emissive) {
        const glm::dvec3 p0(triangle.p0), e1(triangle.edge1), e2(triangle.edge2);
        area += 0.5 * glm::length(glm::cross(e1, e2));
        for (const glm::dvec3& corner : {p0, p0 + e1, p0 + e2}) {
            lo = glm::min(lo, corner);
            hi = glm::max(hi, corner);
        }
    }
    const glm::dvec3 size = hi - lo;
    return area >= kOneLamp * 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
}

/// `localCount`: punctual lights that are somewhere.
LightChoice settleChoice(LightChoice choice, std::span<const shared::EmissiveData> emissive, size_t localCount) {
    const size_t count = emissive.size() + localCount;
    if (choice == LightChoice::tree && count < 2) return LightChoice::power;
    if (choice != LightChoice::automatic) return choice;
    const bool isMany = localCount >= kManyPunctual || (count >= kManyLights && !(localCount == 0 && isOneLamp(emissive)));
    return isMany ? LightChoice::tree : LightChoice::power;
}

/// Probabilities of the kinds of light, from their power.
struct KindFlux {
    double flux = 0.0;
    bool isPresent = false;
};

void shareSamples(KindFlux emissive, KindFlux punctual, KindFlux environment, LightChoice choice, LightTables& lights) {
    const double kinds = (emissive.isPresent ? 1.0 : 0.0) + (punctual.isPresent ? 1.0 : 0.0) + (environment.isPresent ? 1.0 : 0.0);
    const double total = emissive.flux + punctual.flux + environment.flux;
    const auto share = [&](const KindFlux& kind) {
        if (!kind.isPresent) return 0.0f;
        const double byFlux = total > 0.0 && choice != LightChoice::uniform ? kind.flux / total : 1.0 / kinds;
        return static_cast<float>((1.0 - kEvenShare) * byFlux + kEvenShare / kinds);
    };
    lights.shareEmissive = share(emissive);
    lights.sharePunctual = share(punctual);
    lights.shareEnvironment = share(environment);
}

void packEnvironment(const Scene& scene, LightTables& lights) {
    if (!scene.environment) return;
    const Bitmap& map = scene.environment->radiance;
    if (map.pixelCount() == 1) {
        lights.environmentConstant = {map.pixels[0], map.pixels[1], map.pixels[2]};
        return;
    }
    std::vector<double> weights(map.pixelCount());
    for (int y = 0; y < map.height; ++y) {
        const double sine = std::sin(pi * (y + 0.5) / map.height);
        for (int x = 0; x < map.width; ++x) {
            const float* p = map.at(x, y);
            weights[static_cast<size_t>(y) * map.width + x] = sine * luminance(p);
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
    lights.environmentMean = mean;
}

/// As packEnvironment() but for the arrays.
void adoptEnvironment(const LightTables& known, LightTables& lights) {
    lights.environmentConstant = known.environmentConstant;
    lights.environmentWidth = known.environmentWidth;
    lights.environmentHeight = known.environmentHeight;
    lights.environmentMean = known.environmentMean;
}

double environmentFlux(const LightTables& lights, double sceneRadius) {
    return pi * sceneRadius * sceneRadius * lights.environmentMean * 2.0 * pi * pi;
}

}  // namespace

bool hasSunLight(const Scene& scene, const LightConfig& config) {
    return config.allPunctual && scene.environment && scene.environment->parts;
}

LightTables packLights(const Scene& scene, float sceneRadius, MaterialTables& materials, const LightConfig& config,
                       const LightTables* known) {
    LightTables lights;
    const std::vector<float> emitted = weighMaterials(scene, materials, config.choice);
    const double emissive = emitted.empty() ? 0.0 : packEmissive(scene, materials, emitted, lights);
    const std::vector<Light> punctual = punctualLights(scene, config);
    const auto localCount = static_cast<size_t>(std::count_if(punctual.begin(), punctual.end(), isLocal));
    const LightChoice choice = settleChoice(config.choice, lights.emissive, localCount);
    const PunctualFlux flux = packPunctual(punctual, sceneRadius, choice, config.allPunctual, lights);
    if (!config.allPunctual) countShapes(punctual, lights);
    if (known != nullptr)
        adoptEnvironment(*known, lights);
    else
        packEnvironment(scene, lights);
    const KindFlux sky{environmentFlux(lights, sceneRadius), lights.environmentWidth > 0};
    if (choice == LightChoice::tree) {
        packLightTree(scene, emitted, lights);
        shareSamples({emissive + flux.local, true}, {flux.directional, localCount < punctual.size()}, sky, choice, lights);
    } else {
        shareSamples({emissive, !lights.emissive.empty()}, {flux.local + flux.directional, !punctual.empty()}, sky, choice, lights);
    }
    return lights;
}

}  // namespace raylab
