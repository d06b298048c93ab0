#include "engine/scene/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/scene/data_uri.h"
#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_extras.h"
#include "engine/scene/gltf_lobes.h"
#include "engine/scene/resource_path.h"

namespace raylab {
namespace {

/// What all materials of a document share while they are read.
struct Context {
    const GltfDocument& document;
    TextureRequests& requests;
    std::vector<std::string>& warnings;
    std::map<std::string, size_t> unread;  ///< features that are left out, with the number of materials that use them
};

/// One material on its way.
struct Draft {
    Context& context;
    Material material;
    UvUse uvUse;
    bool hasTexture = false;
    bool uvsDisagree = false;
};

float unit(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }

glm::vec3 notNegative(glm::vec3 v) { return glm::max(v, glm::vec3(0.0f)); }

ImageSource imageSource(const GltfDocument& document, size_t index) {
    const JsonView root = document.root();
    const JsonView image = root.array("images").element(index);
    const std::string key = document.path.filename().string() + " image " + std::to_string(index);
    const std::string label = image.text("name", "");
    if (const auto view = image.index("bufferView", root.array("bufferViews").size()))
        return {.name = key, .file = {}, .bytes = viewBytes(document, *view), .dataUri = {}, .label = label};
    if (!image.has("uri")) image.fail("has neither a uri nor a bufferView");
    const std::string uri = image.text("uri", "");
    if (isDataUri(uri))
        return {.name = key,
                .file = {},
                .bytes = {},
                .dataUri = image.json()["uri"].get_ref<const std::string&>(),
                .label = label};
    ImageSource source = imageFile(resolveResource(document.path.parent_path(), uri));
    source.label = label;
    return source;
}

Wrap wrapOf(const JsonView& sampler, const char* key) {
    switch (sampler.count(key, 10497)) {
        case 10497:
            return Wrap::repeat;
        case 33071:
            return Wrap::clamp;
        case 33648:
            return Wrap::mirror;
        default:
            sampler.fail(std::string("has an unknown ") + key);
    }
}

/// KHR_texture_transform: offset * rotation * scale, the rotation counter-clockwise as seen with v downwards.
UvUse uvUseOf(const JsonView& info) {
    const JsonView extension = info.object("extensions").object("KHR_texture_transform");
    const std::vector<double> offset = extension.numbers("offset", {0.0, 0.0});
    const std::vector<double> scale = extension.numbers("scale", {1.0, 1.0});
    const double angle = extension.number("rotation", 0.0);
    const double c = std::cos(angle), s = std::sin(angle);
    UvUse use{.set = extension.count("texCoord", info.count("texCoord", 0)), .transform = glm::mat3(1.0f)};
    use.transform[0] = glm::vec3(c * scale[0], -s * scale[0], 0.0);
    use.transform[1] = glm::vec3(s * scale[1], c * scale[1], 0.0);
    use.transform[2] = glm::vec3(offset[0], offset[1], 1.0);
    return use;
}

void noteUvUse(Draft& draft, const UvUse& use) {
    if (!draft.hasTexture) draft.uvUse = use;
    draft.hasTexture = true;
    draft.uvsDisagree |= use.set != draft.uvUse.set || use.transform != draft.uvUse.transform;
}

int32_t textureOf(Draft& draft, const JsonView& owner, const char* key, TextureRole role) {
    if (!owner.has(key)) return kNoTexture;
    const GltfDocument& document = draft.context.document;
    const JsonView root = document.root();
    const JsonView info = owner.object(key);
    const auto index = info.index("index", root.array("textures").size());
    if (!index) info.fail("names no texture");
    const JsonView texture = root.array("textures").element(*index);
    const auto source = texture.index("source", root.array("images").size());
    if (!source) {
        draft.context.warnings.push_back("texture " + std::to_string(*index) + " of material \"" + draft.material.name +
                                         "\" was left out: it has no PNG or JPEG image");
        return kNoTexture;
    }
    noteUvUse(draft, uvUseOf(info));
    TextureRequest request{
        .image = imageSource(document, *source), .alpha = {}, .role = role, .usedBy = draft.material.name};
    const JsonView samplers = root.array("samplers");
    if (const auto sampler = texture.index("sampler", samplers.size())) {
        request.wrapU = wrapOf(samplers.element(*sampler), "wrapS");
        request.wrapV = wrapOf(samplers.element(*sampler), "wrapT");
    }
    return draft.context.requests.add(std::move(request));
}

void readBaseColor(Draft& draft, const JsonView& owner, const char* factorKey, const char* textureKey) {
    const std::vector<double> color = owner.numbers(factorKey, {1.0, 1.0, 1.0, 1.0});
    draft.material.baseColor = notNegative(glm::vec3(color[0], color[1], color[2]));
    draft.material.alpha = unit(color[3]);
    draft.material.baseColorTexture = textureOf(draft, owner, textureKey, TextureRole::color);
}

void readMetallicRoughness(Draft& draft, const JsonView& pbr) {
    readBaseColor(draft, pbr, "baseColorFactor", "baseColorTexture");
    draft.material.metallic = unit(pbr.number("metallicFactor", 1.0));
    draft.material.roughness = unit(pbr.number("roughnessFactor", 1.0));
    draft.material.metallicRoughnessTexture = textureOf(draft, pbr, "metallicRoughnessTexture", TextureRole::data);
}

/// The older workflow, reduced to its diffuse colour and glossiness; its specular colour has no place in the model.
void readSpecularGlossiness(Draft& draft, const JsonView& extension) {
    readBaseColor(draft, extension, "diffuseFactor", "diffuseTexture");
    draft.material.metallic = 0.0f;
    draft.material.roughness = unit(1.0 - extension.number("glossinessFactor", 1.0));
    draft.material.metallicRoughnessTexture = kNoTexture;
    ++draft.context.unread["specular colours of KHR_materials_pbrSpecularGlossiness"];
}

void readAlphaMode(Material& material, const JsonView& json) {
    const std::string mode = json.text("alphaMode", "OPAQUE");
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") json.fail("has the alphaMode \"" + mode + "\"");
    material.alphaMode = mode == "MASK" ? AlphaMode::mask : mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
    material.alphaCutoff = unit(json.number("alphaCutoff", 0.5));
}

void readTransmission(Draft& draft, const JsonView& extensions) {
    Material& material = draft.material;
    const JsonView transmission = extensions.object("KHR_materials_transmission");
    material.transmission = unit(transmission.number("transmissionFactor", 0.0));
    material.ior = static_cast<float>(extensions.object("KHR_materials_ior").number("ior", 1.5));
    if (material.ior < 1.0f) {
        draft.context.warnings.push_back("material \"" + material.name + "\" has an ior below 1, taken as 1");
        material.ior = 1.0f;
    }
    const JsonView volume = extensions.object("KHR_materials_volume");
    material.thin = !(volume.number("thicknessFactor", 0.0) > 0.0);
}

void readSpecular(Draft& draft, const JsonView& extensions) {
    const JsonView specular = extensions.object("KHR_materials_specular");
    draft.material.specular = unit(specular.number("specularFactor", 1.0));
}

glm::vec3 colorWithin(const JsonView& owner, const char* key, glm::vec3 fallback) {
    const glm::vec3 color = owner.vec3(key, fallback);
    if (glm::any(glm::lessThan(color, glm::vec3(0.0f))) || glm::any(glm::greaterThan(color, glm::vec3(1.0f))))
        owner.fail(std::string("needs a ") + key + " of three numbers between 0 and 1");
    return color;
}

/// `extras.raylab.phong`: docs/scene-format.md.
std::optional<PhongMaterial> readPhong(const JsonView& json) {
    const std::optional<JsonView> extras = raylabExtras(json);
    if (!extras || !extras->has("phong")) return std::nullopt;
    const JsonView view = extras->object("phong");
    PhongMaterial phong;
    phong.diffuse = colorWithin(view, "diffuse", phong.diffuse);
    phong.specular = colorWithin(view, "specular", phong.specular);
    phong.exponent = static_cast<float>(numberBetween(view, "exponent", 1.0, 1e4, double{phong.exponent}));
    phong.mirror = colorWithin(view, "mirror", phong.mirror);
    phong.tint = colorWithin(view, "tint", phong.tint);
    phong.reflection = static_cast<float>(numberBetween(view, "reflection", 0.0, 1.0, double{phong.reflection}));
    phong.ior = static_cast<float>(numberBetween(view, "ior", 1.0, 1e6, double{phong.ior}));
    return phong;
}

void makeUnlit(Material& material) {
    material.emission = material.baseColor;
    material.emissionTexture = material.baseColorTexture;
    material.baseColor = glm::vec3(0.0f);
    // The texture stays for its alpha; its colour is multiplied by black.
    material.metallic = 0.0f;
    material.metallicRoughnessTexture = kNoTexture;
    material.roughness = 1.0f;
    material.specular = 0.0f;
    material.doubleSided = true;
}

void noteUnreadExtensions(Draft& draft, const JsonView& extensions) {
    constexpr const char* kRead[] = {"KHR_materials_anisotropy",
                                     "KHR_materials_clearcoat",
                                     "KHR_materials_emissive_strength",
                                     "KHR_materials_ior",
                                     "KHR_materials_pbrSpecularGlossiness",
                                     "KHR_materials_sheen",
                                     "KHR_materials_specular",
                                     "KHR_materials_transmission",
                                     "KHR_materials_unlit",
                                     "KHR_materials_volume"};
    for (const auto& [name, value] : extensions.json().items())
        if (std::find(std::begin(kRead), std::end(kRead), name) == std::end(kRead))
            ++draft.context.unread["materials' " + name];
}

Draft readMaterial(Context& context, const JsonView& json, size_t index) {
    Draft draft{.context = context, .material = {}, .uvUse = {}};
    Material& material = draft.material;
    material.name = json.text("name", "material " + std::to_string(index));
    const JsonView extensions = json.object("extensions");
    if (extensions.has("KHR_materials_pbrSpecularGlossiness"))
        readSpecularGlossiness(draft, extensions.object("KHR_materials_pbrSpecularGlossiness"));
    else
        readMetallicRoughness(draft, json.object("pbrMetallicRoughness"));
    material.normalTexture = textureOf(draft, json, "normalTexture", TextureRole::data);
    material.normalScale = static_cast<float>(json.object("normalTexture").number("scale", 1.0));
    const double strength = extensions.object("KHR_materials_emissive_strength").number("emissiveStrength", 1.0);
    material.emission = notNegative(json.vec3("emissiveFactor", glm::vec3(0.0f)) * static_cast<float>(strength));
    material.emissionTexture = textureOf(draft, json, "emissiveTexture", TextureRole::color);
    material.doubleSided = json.flag("doubleSided", false);
    readAlphaMode(material, json);
    readTransmission(draft, extensions);
    readSpecular(draft, extensions);
    readGltfLobes(json, material, [&draft](const JsonView& extension, const char* key, TextureRole role) {
        return textureOf(draft, extension, key, role);
    });
    material.phong = readPhong(json);
    noteUnreadExtensions(draft, extensions);
    if (extensions.has("KHR_materials_unlit")) makeUnlit(material);
    if (draft.uvsDisagree)
        context.warnings.push_back(
            "material \"" + material.name +
            "\": its textures use different texture coordinates or transforms; all use those of the first");
    return draft;
}

}  // namespace

std::vector<UvUse> readGltfMaterials(const GltfDocument& document, TextureRequests& requests, Scene& scene) {
    Context context{.document = document, .requests = requests, .warnings = scene.warnings, .unread = {}};
    const JsonView materials = document.root().array("materials");
    std::vector<UvUse> uvUses;
    for (size_t m = 0; m < materials.size(); ++m) {
        Draft draft = readMaterial(context, materials.element(m), m);
        uvUses.push_back(draft.uvUse);
        scene.materials.push_back(std::move(draft.material));
    }
    for (const auto& [what, count] : context.unread)
        if (count > 0)
            scene.warnings.push_back(what + " are not read; materials that use them: " + std::to_string(count));
    return uvUses;
}

}  // namespace raylab
