#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "engine/core/error.h"
#include "engine/scene/texture_slots.h"
#include "ui/editor/model/edit_materials.h"

namespace raylab::editor {
namespace {

using nlohmann::json;

constexpr const char* kSchema = "raylab.material/1";

/// Each number of a material with its key: `visit(key, field)`. Textures and the name are apart.
template <class AnyMaterial, class Visit>
void visitMaterial(AnyMaterial& material, Visit&& visit) {
    visit("baseColor", material.baseColor);
    visit("alpha", material.alpha);
    visit("metallic", material.metallic);
    visit("roughness", material.roughness);
    visit("normalScale", material.normalScale);
    visit("emission", material.emission);
    visit("alphaMode", material.alphaMode);
    visit("alphaCutoff", material.alphaCutoff);
    visit("transmission", material.transmission);
    visit("ior", material.ior);
    visit("thin", material.thin);
    visit("specular", material.specular);
    visit("doubleSided", material.doubleSided);
    visit("specularColor", material.specularColor);
    visit("clearcoat", material.clearcoat);
    visit("clearcoatRoughness", material.clearcoatRoughness);
    visit("clearcoatNormalScale", material.lobeTextures.clearcoatNormalScale);
    visit("sheenColor", material.sheenColor);
    visit("sheenRoughness", material.sheenRoughness);
    visit("anisotropy", material.anisotropy);
    visit("anisotropyRotationRadians", material.anisotropyRotationRadians);
    visit("attenuationColor", material.attenuationColor);
    visit("attenuationDistance", material.attenuationDistance);
    visit("thickness", material.thickness);
    visit("priority", material.priority);
}

struct TextureKey {
    const char* name;
    bool srgb;
};

/// Of textureSlots(), in their order.
constexpr std::array kTextureKeys = {TextureKey{"baseColor", true},
                                     TextureKey{"metallicRoughness", false},
                                     TextureKey{"normal", false},
                                     TextureKey{"emission", true},
                                     TextureKey{"clearcoat", false},
                                     TextureKey{"clearcoatRoughness", false},
                                     TextureKey{"clearcoatNormal", false},
                                     TextureKey{"sheenColor", true},
                                     TextureKey{"sheenRoughness", false},
                                     TextureKey{"anisotropy", false},
                                     TextureKey{"specular", false},
                                     TextureKey{"specularColor", true},
                                     TextureKey{"transmission", false},
                                     TextureKey{"thickness", false}};
static_assert(kTextureKeys.size() == std::tuple_size_v<decltype(textureSlots(std::declval<Material&>()))>);

template <class AnyPhong, class Visit>
void visitPhong(AnyPhong& phong, Visit&& visit) {
    visit("diffuse", phong.diffuse);
    visit("specular", phong.specular);
    visit("exponent", phong.exponent);
    visit("mirror", phong.mirror);
    visit("tint", phong.tint);
    visit("reflection", phong.reflection);
    visit("ior", phong.ior);
}

struct Writer {
    json& target;
    void operator()(const char* key, const glm::vec3& v) const { target[key] = {v.x, v.y, v.z}; }
    void operator()(const char* key, AlphaMode mode) const { target[key] = static_cast<uint32_t>(mode); }
    /// JSON has no infinity: what is not there stands for it.
    void operator()(const char* key, float value) const {
        target[key] = std::isfinite(value) ? json(value) : json(nullptr);
    }
    void operator()(const char* key, uint32_t value) const { target[key] = value; }
    void operator()(const char* key, bool value) const { target[key] = value; }
};

/// Keys that are missing leave their field alone.
struct Reader {
    const json& source;
    void operator()(const char* key, glm::vec3& v) const {
        if (!source.contains(key)) return;
        for (int c = 0; c < 3; ++c) v[c] = source[key].at(static_cast<size_t>(c)).get<float>();
    }
    void operator()(const char* key, AlphaMode& mode) const {
        if (source.contains(key)) mode = static_cast<AlphaMode>(std::min(source[key].get<uint32_t>(), 2u));
    }
    void operator()(const char* key, float& value) const {
        if (!source.contains(key)) return;
        value = source[key].is_null() ? std::numeric_limits<float>::infinity() : source[key].get<float>();
    }
    void operator()(const char* key, uint32_t& value) const {
        if (source.contains(key)) value = source[key].get<uint32_t>();
    }
    void operator()(const char* key, bool& value) const {
        if (source.contains(key)) value = source[key].get<bool>();
    }
};

int32_t findTexture(const Scene& scene, const std::string& name, bool srgb) {
    for (size_t t = 0; t < scene.textures.size(); ++t)
        if (scene.textures[t].name == name && scene.textures[t].srgb == srgb) return static_cast<int32_t>(t);
    return kNoTexture;
}

Material parseMaterial(const std::string& text, const Scene& scene, Material material) {
    try {
        const json source = json::parse(text);
        if (source.at("schema") != kSchema) throw Error("");
        visitMaterial(material, Reader{source});
        const auto slots = textureSlots(material);
        for (size_t i = 0; i < slots.size(); ++i) {
            const std::string name = source.at("textures").value(kTextureKeys[i].name, "");
            *slots[i] = name.empty() ? kNoTexture : findTexture(scene, name, kTextureKeys[i].srgb);
        }
        material.phong.reset();
        if (source.contains("phong")) visitPhong(material.phong.emplace(), Reader{source["phong"]});
        return material;
    } catch (const std::exception&) {
        throw Error("the clipboard holds no material; copy one first");
    }
}

}  // namespace

std::string materialText(const Material& material, const Scene& scene) {
    json text = {{"schema", kSchema}, {"name", material.name}, {"textures", json::object()}};
    visitMaterial(material, Writer{text});
    const auto slots = textureSlots(material);
    for (size_t i = 0; i < slots.size(); ++i)
        if (*slots[i] != kNoTexture)
            text["textures"][kTextureKeys[i].name] = scene.textures[static_cast<size_t>(*slots[i])].name;
    if (material.phong) visitPhong(*material.phong, Writer{text["phong"]});
    return text.dump(2, ' ', false, json::error_handler_t::replace);
}

Edit pasteMaterial(uint32_t index, const std::string& text) {
    static_cast<void>(parseMaterial(text, {}, {}));
    return {"Paste material", [index, text](EditState& state) {
                const Material pasted = parseMaterial(text, state.scene, state.scene.materials[index]);
                setMaterial(index, pasted, "all").change(state);
            }};
}

}  // namespace raylab::editor
