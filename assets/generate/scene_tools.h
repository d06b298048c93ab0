#pragma once

#include <string>

#include "assets/generate/mesh_tools.h"
#include "assets/generate/surface_maps.h"
#include "engine/scene/scene.h"

namespace raylab::assets {

/// Textures repeat in both directions. `srgb` for colours. The index, for a material.
int32_t addTexture(Scene& scene, const std::string& name, SurfaceMap map, bool srgb);
uint32_t addMaterial(Scene& scene, const Material& material);
/// Meshes are stored once, whatever number of instances shows them.
uint32_t addMesh(Scene& scene, const std::string& name, const Geometry& geometry, uint32_t material);
void addInstance(Scene& scene, const std::string& name, uint32_t mesh,
                 const glm::mat4& objectToWorld = glm::mat4(1.0f));
void addCamera(Scene& scene, const std::string& name, glm::vec3 eye, glm::vec3 target, float fovYRadians);

/// A material with every map that was painted.
Material texturedMaterial(Scene& scene, const std::string& name, const SurfaceMaps& maps, float roughness);

Material plainMaterial(const std::string& name, glm::vec3 baseColor, float roughness, float metallic = 0.0f);

/// `tint` is what one passage through the surface leaves of white light.
Material glassMaterial(const std::string& name, glm::vec3 tint);

}  // namespace raylab::assets
