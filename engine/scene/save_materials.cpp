#include <algorithm>
#include <cmath>

#include "engine/scene/save_parts.h"

namespace raylab {
namespace {

using nlohmann::json;

constexpr int kLinear = 9729;              ///< glTF 2.0, section 5.26: magFilter LINEAR
constexpr int kLinearMipmapLinear = 9987;  ///< minFilter LINEAR_MIPMAP_LINEAR

int wrapCode(Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return 10497;
        case Wrap::clamp:
            return 33071;
        case Wrap::mirror:
            return 33648;
    }
    return 10497;
}

/// Index of the sampler; one a pair of wrap modes.
size_t samplerOf(const Texture& texture, json& document) {
    const json sampler = {{"magFilter", kLinear},
                          {"minFilter", kLinearMipmapLinear},
                          {"wrapS", wrapCode(texture.wrapU)},
                          {"wrapT", wrapCode(texture.wrapV)}};
    const json& known = document["samplers"];
    const auto found = std::find(known.begin(), known.end(), sampler);
    if (found != known.end()) return static_cast<size_t>(found - known.begin());
    return appendTo(document, "samplers", sampler);
}

void setTexture(json& owner, const char* key, int32_t texture) {
    if (texture != kNoTexture) owner[key]["index"] = texture;
}

json pbrJson(const Material& material) {
    const glm::vec3 color = material.baseColor;
    json pbr = {{"baseColorFactor", {color.x, color.y, color.z, material.alpha}},
                {"metallicFactor", material.metallic},
                {"roughnessFactor", material.roughness}};
    setTexture(pbr, "baseColorTexture", material.baseColorTexture);
    setTexture(pbr, "metallicRoughnessTexture", material.metallicRoughnessTexture);
    return pbr;
}

bool hasVolume(const Material& m) {
    return !m.thin || m.attenuationColor != glm::vec3(1.0f) || std::isfinite(m.attenuationDistance);
}

json volumeJson(const Material& material) {
    json volume = json::object();
    // The thickness is for rasterisers: a ray knows where it leaves a volume.
    if (!material.thin) volume["thicknessFactor"] = material.thickness;
    if (material.attenuationColor != glm::vec3(1.0f)) volume["attenuationColor"] = toJson(material.attenuationColor);
    if (std::isfinite(material.attenuationDistance)) volume["attenuationDistance"] = material.attenuationDistance;
    return volume;
}

/// Clear coat, sheen and anisotropy.
void addLobes(const Material& m, json& extensions) {
    if (m.clearcoat != 0.0f || m.clearcoatRoughness != 0.0f)
        extensions["KHR_materials_clearcoat"] = {{"clearcoatFactor", m.clearcoat},
                                                 {"clearcoatRoughnessFactor", m.clearcoatRoughness}};
    if (m.sheenColor != glm::vec3(0.0f) || m.sheenRoughness != 0.0f)
        extensions["KHR_materials_sheen"] = {{"sheenColorFactor", toJson(m.sheenColor)},
                                             {"sheenRoughnessFactor", m.sheenRoughness}};
    if (m.anisotropy != 0.0f || m.anisotropyRotationRadians != 0.0f)
        extensions["KHR_materials_anisotropy"] = {{"anisotropyStrength", m.anisotropy},
                                                  {"anisotropyRotation", m.anisotropyRotationRadians}};
}

/// A texture of a factor that glTF takes for granted is saved all the same: an extension of its own for it.
void addLobeTextures(const LobeTextures& t, json& extensions) {
    const auto set = [&extensions](const char* extension, const char* key, int32_t texture) {
        if (texture != kNoTexture) setTexture(extensions[extension], key, texture);
    };
    set("KHR_materials_clearcoat", "clearcoatTexture", t.clearcoat);
    set("KHR_materials_clearcoat", "clearcoatRoughnessTexture", t.clearcoatRoughness);
    set("KHR_materials_clearcoat", "clearcoatNormalTexture", t.clearcoatNormal);
    if (t.clearcoatNormal != kNoTexture)
        extensions["KHR_materials_clearcoat"]["clearcoatNormalTexture"]["scale"] = t.clearcoatNormalScale;
    set("KHR_materials_sheen", "sheenColorTexture", t.sheenColor);
    set("KHR_materials_sheen", "sheenRoughnessTexture", t.sheenRoughness);
    set("KHR_materials_anisotropy", "anisotropyTexture", t.anisotropy);
    set("KHR_materials_specular", "specularTexture", t.specular);
    set("KHR_materials_specular", "specularColorTexture", t.specularColor);
    set("KHR_materials_transmission", "transmissionTexture", t.transmission);
    set("KHR_materials_volume", "thicknessTexture", t.thickness);
}

/// Only those that differ from what glTF takes for granted.
json extensionsJson(const Material& material) {
    json extensions = json::object();
    if (const float strength = powerOfTwoScale(material.emission); strength != 1.0f)
        extensions["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    if (material.transmission != 0.0f)
        extensions["KHR_materials_transmission"]["transmissionFactor"] = material.transmission;
    if (material.ior != 1.5f) extensions["KHR_materials_ior"]["ior"] = material.ior;
    if (hasVolume(material)) extensions["KHR_materials_volume"] = volumeJson(material);
    if (material.specular != 1.0f) extensions["KHR_materials_specular"]["specularFactor"] = material.specular;
    if (material.specularColor != glm::vec3(1.0f))
        extensions["KHR_materials_specular"]["specularColorFactor"] = toJson(material.specularColor);
    addLobes(material, extensions);
    addLobeTextures(material.lobeTextures, extensions);
    return extensions;
}

void setAlphaMode(json& result, const Material& material) {
    if (material.alphaMode == AlphaMode::mask) result["alphaMode"] = "MASK";
    if (material.alphaMode == AlphaMode::blend) result["alphaMode"] = "BLEND";
    if (material.alphaCutoff != 0.5f) result["alphaCutoff"] = material.alphaCutoff;
}

/// What glTF has no place for.
json phongJson(const PhongMaterial& phong) {
    return {{"diffuse", toJson(phong.diffuse)}, {"specular", toJson(phong.specular)}, {"exponent", phong.exponent},
            {"mirror", toJson(phong.mirror)},   {"tint", toJson(phong.tint)},         {"reflection", phong.reflection},
            {"ior", phong.ior}};
}

json materialJson(const Material& material, json& document) {
    json result = {{"name", material.name}, {"pbrMetallicRoughness", pbrJson(material)}};
    setTexture(result, "normalTexture", material.normalTexture);
    if (material.normalTexture != kNoTexture) result["normalTexture"]["scale"] = material.normalScale;
    setTexture(result, "emissiveTexture", material.emissionTexture);
    if (material.emission != glm::vec3(0.0f))
        result["emissiveFactor"] = toJson(material.emission / powerOfTwoScale(material.emission));
    if (material.doubleSided) result["doubleSided"] = true;
    setAlphaMode(result, material);
    const json extensions = extensionsJson(material);
    for (const auto& [name, value] : extensions.items()) useExtension(document, name.c_str());
    if (!extensions.empty()) result["extensions"] = extensions;
    if (material.priority != 0) result["extras"]["raylab"]["priority"] = material.priority;
    if (material.phong) result["extras"]["raylab"]["phong"] = phongJson(*material.phong);
    return result;
}

}  // namespace

float powerOfTwoScale(glm::vec3 v) {
    int exponent = 0;
    const float fraction = std::frexp(std::max({v.x, v.y, v.z, 1.0f}), &exponent);  // in [1/2, 1)
    return std::ldexp(1.0f, fraction == 0.5f ? exponent - 1 : exponent);
}

void addMaterials(const Scene& scene, nlohmann::json& document) {
    for (size_t t = 0; t < scene.textures.size(); ++t)
        appendTo(document, "textures", {{"source", t}, {"sampler", samplerOf(scene.textures[t], document)}});
    for (const Material& material : scene.materials) appendTo(document, "materials", materialJson(material, document));
}

}  // namespace raylab
