#pragma once

#include <filesystem>

#include "ui/editor/model/document.h"

/// Edits of materials. Indices count Scene::materials and exist.
namespace raylab::editor {

/// `what` names the part that changes ("roughness"); a slider's drag gives all its edits one `mergeKey`. Numbers are
/// taken into the ranges that the importer accepts.
Edit setMaterial(uint32_t index, Material material, const std::string& what, std::string mergeKey = {});

/// The new material is selected. One that no mesh wears is gone after the next import.
Edit addMaterial(Material material);

/// Throws Error on apply while meshes with instances wear it.
Edit deleteMaterial(uint32_t index);

/// What the F0 table says of a substance (engine/scene/f0_presets.h); roughness, textures, emission and name stay, and
/// so does the colour below a dielectric's surface. Throws Error for an unknown name.
Edit applyPreset(uint32_t index, const std::string& preset);

/// A picture slot of a material.
enum class TextureSlot { baseColor, metallicRoughness, normal, emission };

inline constexpr TextureSlot kTextureSlots[] = {TextureSlot::baseColor, TextureSlot::metallicRoughness,
                                                TextureSlot::normal, TextureSlot::emission};

const char* textureSlotName(TextureSlot slot);
int32_t& textureAt(Material& material, TextureSlot slot);
int32_t textureAt(const Material& material, TextureSlot slot);
/// Whether the colours of a picture in the slot are sRGB.
bool isColorSlot(TextureSlot slot);

/// A texture of the scene, or kNoTexture. A texture that is read as the slot does not (sRGB or linear) is copied as one
/// that is. Meshes get the tangents that a normal map asks for.
Edit setTexture(uint32_t material, TextureSlot slot, int32_t texture);

/// Gives the meshes that wear the material tangents, where these change what it looks like.
void supplyTangents(Scene& scene, uint32_t material);

/// Reads an image into the slot. Throws Error, before there is an edit, where it cannot be read.
Edit loadTexture(uint32_t material, TextureSlot slot, const std::filesystem::path& file);

/// As text for the clipboard; textures by name.
std::string materialText(const Material& material, const Scene& scene);
/// All but the name; textures that the scene has not are left out. Throws Error for a text of something else.
Edit pasteMaterial(uint32_t index, const std::string& text);

}  // namespace raylab::editor
