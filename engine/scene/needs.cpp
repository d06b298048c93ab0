#include "engine/scene/needs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/scene/bounds.h"
#include "engine/scene/instance_motion.h"
#include "engine/scene/texture_slots.h"

namespace raylab {
namespace {

/// Boxes of nodes are rounded outwards on a grid of 2^16 steps: where triangles are not several steps long, the rounded
/// boxes of neighbours overlap and culling suffers. A tree of one's own costs a transform of the ray.
constexpr double kGridSteps = 65536.0;
constexpr double kFinestSteps = 4.0;
constexpr size_t kSmallestOwnTree = 256;  // triangles

/// Edge length of a right isosceles triangle of the mesh's mean area, in world space.
double typicalEdge(const Mesh& mesh, const glm::mat4& matrix) {
    if (mesh.triangles.size() < kSmallestOwnTree) return std::numeric_limits<double>::infinity();
    const glm::dmat3 linear(matrix);
    double area = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 p0(mesh.positions[t.x]), p1(mesh.positions[t.y]), p2(mesh.positions[t.z]);
        area += 0.5 * glm::length(glm::cross(linear * (p1 - p0), linear * (p2 - p0)));
    }
    return std::sqrt(2.0 * area / static_cast<double>(mesh.triangles.size()));
}

std::string count(size_t n, const char* one, const char* many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// Materials that an instance shows: a material that no surface wears adds nothing to the kernel.
std::vector<const Material*> wornMaterials(const Scene& scene, const TreePlan& plan) {
    std::vector<bool> worn(scene.materials.size(), false);
    for (size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
        if (plan.useCount[mesh] > 0) worn[scene.meshes[mesh].material] = true;
    std::vector<const Material*> materials;
    for (size_t i = 0; i < worn.size(); ++i)
        if (worn[i]) materials.push_back(&scene.materials[i]);
    return materials;
}

template <class Predicate>
Need materialNeed(uint32_t bit, const char* name, const std::vector<const Material*>& materials, const char* what,
                  Predicate&& predicate) {
    const auto n = static_cast<size_t>(
        std::count_if(materials.begin(), materials.end(), [&](const Material* m) { return predicate(*m); }));
    return {bit, name, n > 0, n > 0 ? count(n, "material ", "materials ") + what : std::string("no material ") + what};
}

bool isAlphaTested(const Material& m) { return m.alphaMode != AlphaMode::opaque; }

bool hasTexture(const Material& m) {
    return std::ranges::any_of(textureSlots(m), [](const int32_t* texture) { return *texture != kNoTexture; });
}

/// That kernels read.
bool hasLobeTexture(const Material& m) {
    LobeTextures read = m.lobeTextures;
    read.thickness = kNoTexture;
    return read != LobeTextures{};
}

/// glTF has the normal of a clear coat from a texture of its own, or from the mesh.
bool hasCoatNormal(const Material& m) {
    const LobeTextures& lobes = m.lobeTextures;
    if (m.clearcoat <= 0.0f || (m.normalTexture == kNoTexture && lobes.clearcoatNormal == kNoTexture)) return false;
    return m.normalTexture != lobes.clearcoatNormal || m.normalScale != lobes.clearcoatNormalScale;
}

bool hasNormalMap(const Material& m) {
    return m.normalTexture != kNoTexture || (m.clearcoat > 0.0f && m.lobeTextures.clearcoatNormal != kNoTexture);
}

bool isLit(glm::vec3 color) { return glm::any(glm::greaterThan(color, glm::vec3(0.0f))); }

bool isSolid(const Material& m) { return m.transmission > 0.0f && !m.thin; }

bool absorbs(const Material& m) {
    return isSolid(m) && std::isfinite(m.attenuationDistance) && m.attenuationColor != glm::vec3(1.0f);
}

bool hasPhongGloss(const Material& m) { return m.phong && (isLit(m.phong->specular) || isLit(m.phong->mirror)); }

Need instancingNeed(const TreePlan& plan) {
    std::string reason = "all that is shown is in one tree in world space";
    if (plan.asked > 0)
        reason = "a tree for each of " + count(plan.asked, "mesh", "meshes");
    else if (plan.hasUpperTree())
        reason = count(plan.sharedMeshes, "mesh is", "meshes are") + " shown more than once, " +
                 count(plan.fineMeshes, "is", "are") + " finer than a grid over the world, " +
                 count(plan.movingMeshes, "moves", "move");
    return {shared::kNeedInstancing, "instancing", plan.hasUpperTree(), reason};
}

Need transformNeed(const Scene& scene) {
    const auto n =
        static_cast<size_t>(std::count_if(scene.instances.begin(), scene.instances.end(),
                                          [](const Instance& i) { return i.objectToWorld != glm::mat4(1.0f) || moves(i); }));
    return {shared::kNeedTransforms, "transforms", n > 0,
            n > 0 ? count(n, "instance is", "instances are") + " moved" : "every matrix is the identity"};
}

Need motionNeed(const Scene& scene) {
    const auto n = static_cast<size_t>(std::ranges::count_if(scene.instances, moves));
    return {shared::kNeedMotion, "motion", n > 0,
            n > 0 ? count(n, "instance moves", "instances move") + " while the shutter is open" : "every instance stands still"};
}

Need smoothNeed(const Scene& scene, const TreePlan& plan) {
    size_t n = 0;
    for (size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
        if (plan.useCount[mesh] > 0 && !scene.meshes[mesh].normals.empty()) ++n;
    return {shared::kNeedSmoothNormals, "smooth normals", n > 0,
            n > 0 ? count(n, "mesh has", "meshes have") + " vertex normals" : "all meshes are flat"};
}

Need quadricNeed(const Scene& scene) {
    const size_t n = quadricCount(scene).instanced;
    return {shared::kNeedQuadrics, "quadrics", n > 0, n > 0 ? count(n, "is shown", "are shown") : "none in the scene"};
}

Need shapeNeed(const Scene& scene) {
    const auto n = static_cast<size_t>(std::count_if(scene.lights.begin(), scene.lights.end(), hasShape));
    return {shared::kNeedShapes, "lights of a shape", n > 0,
            n > 0 ? count(n, "light has", "lights have") + " a size" : "all lights are points or infinitely far away"};
}

/// Edges shorter than this get lost on a grid over the world.
double finestEdge(const Scene& scene) {
    const Bounds bounds = sceneBounds(scene);
    const glm::vec3 extent = bounds.hi - bounds.lo;
    return kFinestSteps * static_cast<double>(std::max({extent.x, extent.y, extent.z})) / kGridSteps;
}

}  // namespace

bool hasShape(const Light& light) {
    if (light.kind == LightKind::directional) return light.angularRadiusRadians > 0.0f;
    return light.kind == LightKind::sphere || light.kind == LightKind::disc || light.kind == LightKind::rectangle;
}

TreePlan planTrees(const Scene& scene, const TreePlanConfig& config) {
    TreePlan plan;
    plan.useCount.resize(scene.meshes.size(), 0);
    plan.ownTree.resize(scene.meshes.size(), false);
    for (const Instance& instance : scene.instances) ++plan.useCount[instance.mesh];
    const double finest = config.gridOverTree ? finestEdge(scene) : 0.0;
    for (const Instance& instance : scene.instances) {
        if (!moves(instance) || plan.ownTree[instance.mesh] || config.treePerMesh) continue;
        plan.ownTree[instance.mesh] = true;
        ++plan.movingMeshes;
    }
    const bool flattens = triangleCount(scene).instanced <= config.flattenLimit;
    for (const Instance& instance : scene.instances) {
        const size_t mesh = instance.mesh;
        const bool isShared = plan.useCount[mesh] > 1 && !flattens;
        if (plan.ownTree[mesh]) continue;
        if (config.treePerMesh) {
            plan.ownTree[mesh] = true;
            ++plan.asked;
            continue;
        }
        if (!isShared && !(finest > 0.0 && typicalEdge(scene.meshes[mesh], instance.objectToWorld) < finest)) continue;
        plan.ownTree[mesh] = true;
        ++(isShared ? plan.sharedMeshes : plan.fineMeshes);
    }
    return plan;
}

SceneNeeds analyseNeeds(const Scene& scene, const TreePlanConfig& config) {
    const TreePlan plan = planTrees(scene, config);
    const std::vector<const Material*> worn = wornMaterials(scene, plan);
    SceneNeeds result;
    result.needs = {
        instancingNeed(plan),
        transformNeed(scene),
        smoothNeed(scene, plan),
        materialNeed(shared::kNeedTextures, "textures", worn, "with a texture", hasTexture),
        materialNeed(shared::kNeedNormalMaps, "normal maps", worn, "with a normal map", hasNormalMap),
        materialNeed(shared::kNeedAlpha, "alpha", worn, "cut out or blended by alpha", isAlphaTested),
        materialNeed(shared::kNeedSpecular, "GGX reflection", worn, "with specular reflection",
                     [](const Material& m) { return m.metallic > 0.0f || m.specular > 0.0f || hasPhongGloss(m); }),
        materialNeed(shared::kNeedTransmission, "transmission", worn, "that light passes through",
                     [](const Material& m) { return m.transmission > 0.0f || (m.phong && isLit(m.phong->tint)); }),
        materialNeed(shared::kNeedEmissive, "emissive triangles", worn, "with emission",
                     [](const Material& m) { return isLit(m.emission); }),
        {shared::kNeedPunctual, "punctual lights", !scene.lights.empty(),
         scene.lights.empty() ? "none in the scene" : count(scene.lights.size(), "light", "lights")},
        shapeNeed(scene),
        {shared::kNeedEnvironment, "environment", scene.environment.has_value(),
         scene.environment ? "radiance from infinitely far away" : "black beyond the scene"},
        quadricNeed(scene),
        materialNeed(shared::kNeedSpecularTint, "specular tint", worn, "of coloured dielectric reflection",
                     [](const Material& m) {
                         return m.metallic < 1.0f && (m.specularColor != glm::vec3(1.0f) ||
                                                      m.lobeTextures.specularColor != kNoTexture);
                     }),
        materialNeed(shared::kNeedClearcoat, "clearcoat", worn, "with a clear coat",
                     [](const Material& m) { return m.clearcoat > 0.0f; }),
        materialNeed(shared::kNeedSheen, "sheen", worn, "with sheen", [](const Material& m) { return isLit(m.sheenColor); }),
        materialNeed(shared::kNeedAnisotropy, "anisotropy", worn, "of anisotropic roughness",
                     [](const Material& m) { return m.anisotropy > 0.0f; }),
        materialNeed(shared::kNeedRoughTransmission, "rough transmission", worn, "that is rough and lets light through",
                     [](const Material& m) { return m.transmission > 0.0f && m.roughness > 0.0f; }),
        materialNeed(shared::kNeedAbsorption, "absorption", worn, "that light fades in", absorbs),
        materialNeed(shared::kNeedNesting, "nested dielectrics", worn, "of a volume with a priority",
                     [](const Material& m) { return isSolid(m) && m.priority > 0; }),
        materialNeed(shared::kNeedLobeTextures, "textures of lobes", worn, "with a texture of a coat, sheen, transmission...",
                     hasLobeTexture),
        materialNeed(shared::kNeedCoatNormals, "normals of coats", worn, "whose clear coat has a normal of its own",
                     hasCoatNormal),
        motionNeed(scene),
    };
    for (const Need& need : result.needs)
        if (need.needed) result.mask |= need.bit;
    return result;
}

}  // namespace raylab
