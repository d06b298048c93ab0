#include "engine/scene/gltf_lobes.h"

#include <algorithm>

#include "engine/scene/gltf_extras.h"

namespace raylab {
namespace {

constexpr double kMostPriority = 65535.0;

float unit(const JsonView& owner, const char* key) {
    return static_cast<float>(std::clamp(owner.number(key, 0.0), 0.0, 1.0));
}

glm::vec3 notNegative(const JsonView& owner, const char* key, glm::vec3 fallback) {
    return glm::max(owner.vec3(key, fallback), glm::vec3(0.0f));
}

glm::vec3 unitColor(const JsonView& owner, const char* key, glm::vec3 fallback) {
    return glm::min(notNegative(owner, key, fallback), glm::vec3(1.0f));
}

void readVolume(const JsonView& volume, Material& material) {
    material.attenuationColor = unitColor(volume, "attenuationColor", glm::vec3(1.0f));
    if (const auto thickness = static_cast<float>(volume.number("thicknessFactor", 0.0)); thickness > 0.0f)
        material.thickness = thickness;
    if (!volume.has("attenuationDistance")) return;
    const double distance = volume.number("attenuationDistance", 0.0);
    if (!(distance > 0.0)) volume.fail("needs an attenuationDistance above 0");
    material.attenuationDistance = static_cast<float>(distance);
}

/// Of what alpha says, the role is that of a colour: alpha is linear in any role, and the colours that such images mostly
/// hold too are then the same texture.
void readTextures(const JsonView& extensions, const TextureReader& textureOf, LobeTextures& t) {
    const JsonView clearcoat = extensions.object("KHR_materials_clearcoat");
    t.clearcoat = textureOf(clearcoat, "clearcoatTexture", TextureRole::data);
    t.clearcoatRoughness = textureOf(clearcoat, "clearcoatRoughnessTexture", TextureRole::data);
    t.clearcoatNormal = textureOf(clearcoat, "clearcoatNormalTexture", TextureRole::data);
    t.clearcoatNormalScale = static_cast<float>(clearcoat.object("clearcoatNormalTexture").number("scale", 1.0));
    const JsonView sheen = extensions.object("KHR_materials_sheen");
    t.sheenColor = textureOf(sheen, "sheenColorTexture", TextureRole::color);
    t.sheenRoughness = textureOf(sheen, "sheenRoughnessTexture", TextureRole::color);
    t.anisotropy = textureOf(extensions.object("KHR_materials_anisotropy"), "anisotropyTexture", TextureRole::data);
    const JsonView specular = extensions.object("KHR_materials_specular");
    t.specular = textureOf(specular, "specularTexture", TextureRole::color);
    t.specularColor = textureOf(specular, "specularColorTexture", TextureRole::color);
    t.transmission = textureOf(extensions.object("KHR_materials_transmission"), "transmissionTexture", TextureRole::data);
    t.thickness = textureOf(extensions.object("KHR_materials_volume"), "thicknessTexture", TextureRole::data);
}

}  // namespace

void readGltfLobes(const JsonView& json, Material& material, const TextureReader& textureOf) {
    const JsonView extensions = json.object("extensions");
    readTextures(extensions, textureOf, material.lobeTextures);
    const JsonView clearcoat = extensions.object("KHR_materials_clearcoat");
    material.clearcoat = unit(clearcoat, "clearcoatFactor");
    material.clearcoatRoughness = unit(clearcoat, "clearcoatRoughnessFactor");
    const JsonView sheen = extensions.object("KHR_materials_sheen");
    material.sheenColor = unitColor(sheen, "sheenColorFactor", glm::vec3(0.0f));
    material.sheenRoughness = unit(sheen, "sheenRoughnessFactor");
    const JsonView anisotropy = extensions.object("KHR_materials_anisotropy");
    material.anisotropy = unit(anisotropy, "anisotropyStrength");
    material.anisotropyRotationRadians = static_cast<float>(anisotropy.number("anisotropyRotation", 0.0));
    material.specularColor =
        notNegative(extensions.object("KHR_materials_specular"), "specularColorFactor", glm::vec3(1.0f));
    readVolume(extensions.object("KHR_materials_volume"), material);
    if (const auto extras = raylabExtras(json); extras && extras->has("priority"))
        material.priority = static_cast<uint32_t>(numberBetween(*extras, "priority", 0.0, kMostPriority, 0.0));
}

}  // namespace raylab
