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

void countTextures(const JsonView& extension, const char* name, std::map<std::string, size_t>& unread) {
    const auto isTexture = [](const auto& member) { return member.key().ends_with("Texture"); };
    const auto members = extension.json().items();
    unread[std::string("textures of ") + name] += std::any_of(members.begin(), members.end(), isTexture);
}

void readVolume(const JsonView& volume, Material& material) {
    material.attenuationColor = unitColor(volume, "attenuationColor", glm::vec3(1.0f));
    if (!volume.has("attenuationDistance")) return;
    const double distance = volume.number("attenuationDistance", 0.0);
    if (!(distance > 0.0)) volume.fail("needs an attenuationDistance above 0");
    material.attenuationDistance = static_cast<float>(distance);
}

}  // namespace

void readGltfLobes(const JsonView& json, Material& material, std::map<std::string, size_t>& unread) {
    const JsonView extensions = json.object("extensions");
    for (const char* name : {"KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_anisotropy",
                             "KHR_materials_specular", "KHR_materials_volume"})
        countTextures(extensions.object(name), name, unread);
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
