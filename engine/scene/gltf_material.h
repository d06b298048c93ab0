#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/gltf_document.h"
#include "engine/scene/import_texture.h"
#include "engine/scene/scene.h"

namespace raylab {

/// How a material reads texture coordinates. Scene has one set a mesh, so all textures of a material must agree.
struct UvUse {
    size_t set = 0;
    glm::mat3 transform{1.0f};  ///< KHR_texture_transform, to be baked into the vertices
};

/// Materials of a glTF document, in its order, with the extensions KHR_materials_{anisotropy, clearcoat,
/// emissive_strength, ior, pbrSpecularGlossiness, sheen, specular, transmission, unlit, volume} and KHR_texture_transform. KHR_materials_unlit becomes a black
/// surface that emits the base colour: it looks the same under any light (and lights its surroundings, as any lamp).
/// Appends to scene.materials, scene.warnings and `requests`; result: one entry a material.
std::vector<UvUse> readGltfMaterials(const GltfDocument& document, TextureRequests& requests, Scene& scene);

}  // namespace raylab
