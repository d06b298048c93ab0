#include <nlohmann/json.hpp>

#include "engine/core/error.h"
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
}

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
    void operator()(const char* key, float value) const { target[key] = value; }
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
        if (source.contains(key)) value = source[key].get<float>();
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
        for (const TextureSlot slot : kTextureSlots) {
            const std::string name = source.at("textures").value(textureSlotName(slot), "");
            textureAt(material, slot) = name.empty() ? kNoTexture : findTexture(scene, name, isColorSlot(slot));
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
    for (const TextureSlot slot : kTextureSlots)
        if (const int32_t texture = textureAt(material, slot); texture != kNoTexture)
            text["textures"][textureSlotName(slot)] = scene.textures[static_cast<size_t>(texture)].name;
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
