#include "engine/scene/needs.h"

#include <algorithm>

namespace raylab {
namespace {

std::string count(size_t n, const char* one, const char* many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// Materials that an instance shows: a material that no surface wears adds nothing to the kernel.
std::vector<const Material*> wornMaterials(const Scene& scene, const InstanceSharing& sharing) {
    std::vector<bool> worn(scene.materials.size(), false);
    for (size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
        if (sharing.useCount[mesh] > 0) worn[scene.meshes[mesh].material] = true;
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
    return m.baseColorTexture != kNoTexture || m.metallicRoughnessTexture != kNoTexture ||
           m.normalTexture != kNoTexture || m.emissionTexture != kNoTexture;
}

Need instancingNeed(const InstanceSharing& sharing) {
    const size_t n = sharing.sharedMeshes;
    return {shared::kNeedInstancing, "instancing", n > 0,
            n > 0 ? count(n, "mesh is", "meshes are") + " shown more than once"
                  : "every mesh is shown once: one tree in world space"};
}

Need transformNeed(const Scene& scene) {
    const auto n =
        static_cast<size_t>(std::count_if(scene.instances.begin(), scene.instances.end(),
                                          [](const Instance& i) { return i.objectToWorld != glm::mat4(1.0f); }));
    return {shared::kNeedTransforms, "transforms", n > 0,
            n > 0 ? count(n, "instance is", "instances are") + " moved" : "every matrix is the identity"};
}

Need smoothNeed(const Scene& scene, const InstanceSharing& sharing) {
    size_t n = 0;
    for (size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
        if (sharing.useCount[mesh] > 0 && !scene.meshes[mesh].normals.empty()) ++n;
    return {shared::kNeedSmoothNormals, "smooth normals", n > 0,
            n > 0 ? count(n, "mesh has", "meshes have") + " vertex normals" : "all meshes are flat"};
}

}  // namespace

InstanceSharing analyseSharing(const Scene& scene) {
    InstanceSharing sharing{std::vector<uint32_t>(scene.meshes.size(), 0), 0};
    for (const Instance& instance : scene.instances) ++sharing.useCount[instance.mesh];
    sharing.sharedMeshes = static_cast<size_t>(
        std::count_if(sharing.useCount.begin(), sharing.useCount.end(), [](uint32_t uses) { return uses > 1; }));
    return sharing;
}

SceneNeeds analyseNeeds(const Scene& scene) {
    const InstanceSharing sharing = analyseSharing(scene);
    const std::vector<const Material*> worn = wornMaterials(scene, sharing);
    SceneNeeds result;
    result.needs = {
        instancingNeed(sharing),
        transformNeed(scene),
        smoothNeed(scene, sharing),
        materialNeed(shared::kNeedTextures, "textures", worn, "with a texture", hasTexture),
        materialNeed(shared::kNeedNormalMaps, "normal maps", worn, "with a normal map",
                     [](const Material& m) { return m.normalTexture != kNoTexture; }),
        materialNeed(shared::kNeedAlpha, "alpha", worn, "cut out or blended by alpha", isAlphaTested),
        materialNeed(shared::kNeedSpecular, "GGX reflection", worn, "that reflects",
                     [](const Material& m) { return m.metallic > 0.0f || m.specular > 0.0f; }),
        materialNeed(shared::kNeedTransmission, "transmission", worn, "that light passes through",
                     [](const Material& m) { return m.transmission > 0.0f; }),
        materialNeed(shared::kNeedEmissive, "emissive triangles", worn, "that emits",
                     [](const Material& m) { return glm::any(glm::greaterThan(m.emission, glm::vec3(0.0f))); }),
        {shared::kNeedPunctual, "punctual lights", !scene.lights.empty(),
         scene.lights.empty() ? "none in the scene" : count(scene.lights.size(), "light", "lights")},
        {shared::kNeedEnvironment, "environment", scene.environment.has_value(),
         scene.environment ? "radiance from infinitely far away" : "black beyond the scene"},
    };
    for (const Need& need : result.needs)
        if (need.needed) result.mask |= need.bit;
    return result;
}

}  // namespace raylab
