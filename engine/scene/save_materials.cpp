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

/// Only those that differ from what glTF takes for granted.
json extensionsJson(const Material& material) {
    json extensions = json::object();
    if (const float strength = powerOfTwoScale(material.emission); strength != 1.0f)
        extensions["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    if (material.transmission != 0.0f)
        extensions["KHR_materials_transmission"]["transmissionFactor"] = material.transmission;
    if (material.ior != 1.5f) extensions["KHR_materials_ior"]["ior"] = material.ior;
    // The thickness is for rasterisers: a ray knows where it leaves a volume.
    if (!material.thin) extensions["KHR_materials_volume"]["thicknessFactor"] = 1.0f;
    if (material.specular != 1.0f) extensions["KHR_materials_specular"]["specularFactor"] = material.specular;
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
