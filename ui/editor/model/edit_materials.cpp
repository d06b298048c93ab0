#include "ui/editor/model/edit_materials.h"

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/scene/f0_presets.h"
#include "engine/scene/import_mesh.h"
#include "engine/scene/import_texture.h"

namespace raylab::editor {
namespace {

float within(float value, float low, float high) { return std::isfinite(value) ? std::clamp(value, low, high) : low; }

glm::vec3 within(glm::vec3 value, float low, float high) {
    return {within(value.x, low, high), within(value.y, low, high), within(value.z, low, high)};
}

void settlePhong(PhongMaterial& phong) {
    for (glm::vec3* color : {&phong.diffuse, &phong.specular, &phong.mirror, &phong.tint})
        *color = within(*color, 0.0f, 1.0f);
    phong.exponent = within(phong.exponent, 1.0f, 10000.0f);
    phong.reflection = within(phong.reflection, 0.0f, 1.0f);
    phong.ior = within(phong.ior, 1.0f, 1e6f);
}

Material settled(Material material) {
    material.baseColor = within(material.baseColor, 0.0f, 1.0f);
    for (float* share :
         {&material.alpha, &material.metallic, &material.roughness, &material.transmission, &material.specular})
        *share = within(*share, 0.0f, 1.0f);
    material.alphaCutoff = within(material.alphaCutoff, 0.0f, 1.0f);
    material.normalScale = material.normalTexture == kNoTexture ? 1.0f : within(material.normalScale, -100.0f, 100.0f);
    material.emission = within(material.emission, 0.0f, 1e9f);
    material.ior = within(material.ior, 1.0f, 10.0f);
    if (material.phong) settlePhong(*material.phong);
    return material;
}

int32_t addTexture(Scene& scene, Texture texture) {
    scene.textures.push_back(std::move(texture));
    return static_cast<int32_t>(scene.textures.size() - 1);
}

Texture readTexture(const std::filesystem::path& file, TextureSlot slot) {
    TextureRequests requests;
    Scene scratch;
    const TextureRole role = isColorSlot(slot)             ? TextureRole::color
                             : slot == TextureSlot::normal ? TextureRole::bump
                                                           : TextureRole::data;
    Material material;
    material.baseColorTexture =
        requests.add({.image = imageFile(file), .alpha = {}, .role = role, .usedBy = "the material"});
    scratch.materials.push_back(material);
    resolveTextures(requests, scratch);
    if (scratch.textures.empty())
        throw Error(scratch.warnings.empty() ? file.string() + ": is no picture that can be read"
                                             : scratch.warnings.front());
    return std::as_const(scratch.textures).front();
}

size_t wornBy(const Scene& scene, uint32_t material) {
    const auto& meshes = scene.meshes;
    return static_cast<size_t>(std::count_if(scene.instances.begin(), scene.instances.end(),
                                             [&](const Instance& i) { return meshes[i.mesh].material == material; }));
}

void removeMaterial(EditState& state, uint32_t index) {
    Scene& scene = state.scene;
    if (const size_t count = wornBy(scene, index); count > 0)
        throw Error("'" + scene.materials[index].name + "' is worn by " + std::to_string(count) +
                    (count == 1 ? " instance" : " instances") + "; assign another material to them before");
    scene.materials.erase(scene.materials.begin() + index);
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        const uint32_t worn = std::as_const(scene.meshes)[m].material;
        if (worn > index) scene.meshes[m].material = worn - 1;
        if (worn == index) scene.meshes[m].material = 0;  // nothing shows it
    }
    state.selection.material.reset();
}

}  // namespace

const char* textureSlotName(TextureSlot slot) {
    switch (slot) {
        case TextureSlot::baseColor:
            return "base colour";
        case TextureSlot::metallicRoughness:
            return "metallic-roughness";
        case TextureSlot::normal:
            return "normals";
        case TextureSlot::emission:
            return "emission";
    }
    return "";
}

int32_t& textureAt(Material& material, TextureSlot slot) {
    switch (slot) {
        case TextureSlot::metallicRoughness:
            return material.metallicRoughnessTexture;
        case TextureSlot::normal:
            return material.normalTexture;
        case TextureSlot::emission:
            return material.emissionTexture;
        case TextureSlot::baseColor:
            break;
    }
    return material.baseColorTexture;
}

int32_t textureAt(const Material& material, TextureSlot slot) {
    Material copy = material;
    return textureAt(copy, slot);
}

bool isColorSlot(TextureSlot slot) { return slot == TextureSlot::baseColor || slot == TextureSlot::emission; }

void supplyTangents(Scene& scene, uint32_t material) {
    if (!wantsTangents(scene.materials[material])) return;
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = std::as_const(scene.meshes)[m];
        if (mesh.material == material && mesh.tangents.empty() && mesh.quadrics.empty())
            ensureTangents(scene.meshes[m]);
    }
}

Edit setMaterial(uint32_t index, Material material, const std::string& what, std::string mergeKey) {
    return {"Change " + what + " of " + material.name,
            [index, material = settled(std::move(material))](EditState& state) {
                state.scene.materials[index] = material;
                supplyTangents(state.scene, index);
            },
            std::move(mergeKey)};
}

Edit addMaterial(Material material) {
    return {"Add material", [material = settled(std::move(material))](EditState& state) {
                state.scene.materials.push_back(material);
                state.selection = {};
                state.selection.material = static_cast<uint32_t>(state.scene.materials.size() - 1);
            }};
}

Edit deleteMaterial(uint32_t index) {
    return {"Delete material", [index](EditState& state) { removeMaterial(state, index); }};
}

Edit applyPreset(uint32_t index, const std::string& preset) {
    const F0Preset& found = findF0Preset(preset);
    return {"Make it " + preset, [index, &found](EditState& state) {
                Material& material = state.scene.materials[index];
                const Material like = presetMaterial(found, material.roughness, material.baseColor);
                material.baseColor = like.baseColor;
                material.metallic = like.metallic;
                material.ior = like.ior;
                material.specular = like.specular;
                material.phong.reset();
            }};
}

Edit setTexture(uint32_t material, TextureSlot slot, int32_t texture) {
    return {std::string("Change picture of ") + textureSlotName(slot), [material, slot, texture](EditState& state) {
                int32_t chosen = texture;
                const auto& textures = std::as_const(state.scene).textures;
                if (texture != kNoTexture && textures[static_cast<size_t>(texture)].srgb != isColorSlot(slot)) {
                    Texture copy = textures[static_cast<size_t>(texture)];
                    copy.srgb = isColorSlot(slot);
                    chosen = addTexture(state.scene, std::move(copy));
                }
                textureAt(state.scene.materials[material], slot) = chosen;
                supplyTangents(state.scene, material);
            }};
}

Edit loadTexture(uint32_t material, TextureSlot slot, const std::filesystem::path& file) {
    return {"Load picture of " + std::string(textureSlotName(slot)),
            [material, slot, texture = readTexture(file, slot)](EditState& state) {
                textureAt(state.scene.materials[material], slot) = addTexture(state.scene, texture);
                supplyTangents(state.scene, material);
            }};
}

}  // namespace raylab::editor
