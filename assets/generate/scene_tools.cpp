#include "assets/generate/scene_tools.h"

#include <utility>

namespace raylab::assets {

int32_t addTexture(Scene& scene, const std::string& name, SurfaceMap map, bool srgb) {
    scene.textures.push_back(
        {.name = name, .width = map.size, .height = map.size, .texels = std::move(map.texels), .srgb = srgb});
    return static_cast<int32_t>(scene.textures.size() - 1);
}

uint32_t addMaterial(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return static_cast<uint32_t>(scene.materials.size() - 1);
}

uint32_t addMesh(Scene& scene, const std::string& name, const Geometry& geometry, uint32_t material) {
    scene.meshes.push_back({.name = name,
                            .material = material,
                            .positions = geometry.positions,
                            .normals = geometry.normals,
                            .uvs = geometry.uvs,
                            .triangles = geometry.triangles});
    return static_cast<uint32_t>(scene.meshes.size() - 1);
}

void addInstance(Scene& scene, const std::string& name, uint32_t mesh, const glm::mat4& objectToWorld) {
    scene.instances.push_back({name, mesh, objectToWorld});
}

void addCamera(Scene& scene, const std::string& name, glm::vec3 eye, glm::vec3 target, float fovYRadians) {
    scene.cameras.push_back({.name = name, .position = eye, .target = target, .fovYRadians = fovYRadians});
}

Material texturedMaterial(Scene& scene, const std::string& name, const SurfaceMaps& maps, float roughness) {
    Material material{.name = name, .roughness = roughness};
    material.baseColorTexture = addTexture(scene, name + " colour", maps.baseColor, true);
    if (!maps.metallicRoughness.texels.empty())
        material.metallicRoughnessTexture = addTexture(scene, name + " roughness", maps.metallicRoughness, false);
    if (!maps.normal.texels.empty()) material.normalTexture = addTexture(scene, name + " normal", maps.normal, false);
    return material;
}

Material plainMaterial(const std::string& name, glm::vec3 baseColor, float roughness, float metallic) {
    return {.name = name, .baseColor = baseColor, .metallic = metallic, .roughness = roughness};
}

Material glassMaterial(const std::string& name, glm::vec3 tint) {
    return {.name = name, .baseColor = tint, .roughness = 0.0f, .transmission = 1.0f, .thin = false};
}

}  // namespace raylab::assets
