#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace raylab {

/// A glTF document on its way out, with the bytes that its buffer views name.
struct GltfDraft {
    nlohmann::json document;
    std::vector<std::byte> binary;
};

/// Appends to the array under `key`; result: the index. glTF allows no empty arrays, so the first entry makes it.
size_t appendTo(nlohmann::json& owner, const char* key, nlohmann::json entry);

/// Enters an extension into `extensionsUsed`, once.
void useExtension(nlohmann::json& document, const char* name);

/// A new buffer view with `bytes`, four-byte aligned.
size_t addBufferView(GltfDraft& draft, std::span<const std::byte> bytes);

/// The smallest power of two from 1 upwards that no component exceeds: dividing by it loses no bit.
float powerOfTwoScale(glm::vec3 v);

nlohmann::json toJson(glm::vec3 v);

/// Samplers, textures and materials. Texture i has image i, which the caller adds.
void addMaterials(const Scene& scene, nlohmann::json& document);

/// Meshes, quadrics, and a node for each instance, camera and light, in the order of the scene.
void addMeshesAndNodes(const Scene& scene, GltfDraft& draft);

}  // namespace raylab
