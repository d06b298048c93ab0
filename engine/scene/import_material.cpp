#include "engine/scene/import_material.h"

#include <assimp/ObjMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/resource_path.h"

namespace raylab {
namespace {

struct MaterialSource {
    const aiScene& scene;
    const aiMaterial& material;
    std::filesystem::path folder;
    TextureRequests& requests;
};

glm::vec3 colorOf(const MaterialSource& source, const char* key, unsigned type, unsigned index, glm::vec3 fallback) {
    aiColor3D color;
    if (source.material.Get(key, type, index, color) != aiReturn_SUCCESS) return fallback;
    const glm::vec3 value(color.r, color.g, color.b);
    const bool finite = std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
    return finite ? glm::max(value, glm::vec3(0.0f)) : fallback;
}

float numberOf(const MaterialSource& source, const char* key, unsigned type, unsigned index, float fallback) {
    float value = fallback;
    if (source.material.Get(key, type, index, value) != aiReturn_SUCCESS || !std::isfinite(value)) return fallback;
    return value;
}

float largest(glm::vec3 v) { return std::max({v.x, v.y, v.z}); }

Wrap wrapOf(aiTextureMapMode mode) {
    if (mode == aiTextureMapMode_Mirror) return Wrap::mirror;
    return mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? Wrap::clamp : Wrap::repeat;
}

ImageSource imageOf(const MaterialSource& source, const std::string& name) {
    if (const aiTexture* embedded = source.scene.GetEmbeddedTexture(name.c_str())) {
        // Height 0 marks an encoded file of mWidth bytes; Assimp's raw texels come from no format that is read here.
        const size_t size = embedded->mHeight == 0 ? embedded->mWidth : 0;
        return {.name = "embedded " + name,
                .file = {},
                .bytes = {reinterpret_cast<const std::byte*>(embedded->pcData), size},
                .dataUri = {}};
    }
    return imageFile(resolveResource(source.folder, name));
}

/// The first texture of one of Assimp's slots, as a request without a role.
std::optional<TextureRequest> textureOf(const MaterialSource& source, aiTextureType slot, const std::string& usedBy) {
    aiString name;
    aiTextureMapMode modes[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    if (source.material.GetTexture(slot, 0, &name, nullptr, nullptr, nullptr, nullptr, modes) != aiReturn_SUCCESS ||
        name.length == 0)
        return std::nullopt;
    TextureRequest request{.image = imageOf(source, name.C_Str()), .alpha = {}, .usedBy = usedBy};
    request.wrapU = wrapOf(modes[0]);
    request.wrapV = wrapOf(modes[1]);
    return request;
}

int32_t addTexture(const MaterialSource& source, aiTextureType slot, TextureRole role, const std::string& usedBy) {
    std::optional<TextureRequest> request = textureOf(source, slot, usedBy);
    if (!request) return kNoTexture;
    request->role = role;
    return source.requests.add(std::move(*request));
}

/// map_Kd and map_d share a texture, for Scene keeps alpha beside the colour.
void readBaseColorTexture(const MaterialSource& source, Material& material) {
    std::optional<TextureRequest> color = textureOf(source, aiTextureType_DIFFUSE, material.name);
    if (!color) color = textureOf(source, aiTextureType_BASE_COLOR, material.name);
    std::optional<TextureRequest> alpha = textureOf(source, aiTextureType_OPACITY, material.name);
    if (alpha) material.alphaMode = AlphaMode::mask;
    if (!color && !alpha) return;
    TextureRequest request = color ? std::move(*color) : *alpha;
    if (!color) request.image = {};
    if (alpha) request.alpha = std::move(alpha->image);
    material.baseColorTexture = source.requests.add(std::move(request));
}

void readTextures(const MaterialSource& source, Material& material) {
    readBaseColorTexture(source, material);
    material.emissionTexture = addTexture(source, aiTextureType_EMISSIVE, TextureRole::color, material.name);
    if (material.emissionTexture != kNoTexture && material.emission == glm::vec3(0.0f))
        material.emission = glm::vec3(1.0f);
    material.normalTexture = addTexture(source, aiTextureType_NORMALS, TextureRole::data, material.name);
    if (material.normalTexture == kNoTexture)
        material.normalTexture = addTexture(source, aiTextureType_HEIGHT, TextureRole::bump, material.name);
}

/// Perceptual roughness of a Phong exponent: its square is the alpha of GGX.
float roughnessOfExponent(float exponent) { return std::pow(2.0f / (std::max(exponent, 0.0f) + 2.0f), 0.25f); }

void makeGlass(const MaterialSource& source, Material& material) {
    const glm::vec3 filter = colorOf(source, AI_MATKEY_COLOR_TRANSPARENT, glm::vec3(1.0f));
    material.baseColor = filter == glm::vec3(0.0f) ? glm::vec3(1.0f) : glm::min(filter, glm::vec3(1.0f));
    material.baseColorTexture = kNoTexture;
    material.alphaMode = AlphaMode::opaque;
    material.transmission = 1.0f;
    material.roughness = 0.0f;
    material.specular = 1.0f;
    material.thin = false;
}

void makeMirror(const glm::vec3 color, Material& material) {
    material.baseColor = glm::min(color, glm::vec3(1.0f));
    material.metallic = 1.0f;
    material.roughness = 0.0f;
}

/// Illumination models of the MTL format that ask for ray-traced glass or mirrors.
void readIllumination(const MaterialSource& source, float opacity, glm::vec3 specular, Material& material) {
    int model = 0;
    source.material.Get(AI_MATKEY_OBJ_ILLUM, model);
    const bool filters = colorOf(source, AI_MATKEY_COLOR_TRANSPARENT, glm::vec3(1.0f)) != glm::vec3(1.0f);
    if (model == 4 || model == 6 || model == 7 || model == 9 || (filters && opacity < 1.0f))
        makeGlass(source, material);
    else if ((model == 3 || model == 5) && largest(specular) > 0.0f)
        makeMirror(specular, material);
}

/// The model of the format itself; `material`: as it was made of it. Glass keeps of Kd what Tf leaves.
PhongMaterial phongOf(const MaterialSource& source, glm::vec3 specular, const Material& material) {
    PhongMaterial phong;
    phong.diffuse = glm::min(colorOf(source, AI_MATKEY_COLOR_DIFFUSE, glm::vec3(0.8f)), glm::vec3(1.0f));
    phong.specular = glm::min(specular, glm::vec3(1.0f));
    phong.exponent = std::clamp(numberOf(source, AI_MATKEY_SHININESS, 1.0f), 1.0f, 1e4f);
    phong.ior = std::min(material.ior, 1e6f);
    if (material.transmission > 0.0f) {
        phong.tint = material.baseColor;
        phong.diffuse = glm::min(phong.diffuse, glm::vec3(1.0f) - phong.tint);
        phong.mirror = glm::vec3(1.0f);
        const float r0 = (phong.ior - 1.0f) / (phong.ior + 1.0f);
        phong.reflection = r0 * r0;
    } else if (material.metallic > 0.0f) {
        phong.mirror = material.baseColor;
        phong.reflection = 1.0f;
        phong.ior = kOpaqueIor;
    }
    return phong;
}

Material readMaterial(const MaterialSource& source) {
    aiString name;
    source.material.Get(AI_MATKEY_NAME, name);
    if (name.length == 0 || std::string(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME) return defaultMaterial();
    Material material;
    material.name = name.C_Str();
    material.baseColor = glm::min(colorOf(source, AI_MATKEY_COLOR_DIFFUSE, glm::vec3(0.8f)), glm::vec3(1.0f));
    material.emission = colorOf(source, AI_MATKEY_COLOR_EMISSIVE, glm::vec3(0.0f));
    const glm::vec3 specular = colorOf(source, AI_MATKEY_COLOR_SPECULAR, glm::vec3(0.0f));
    material.specular = std::min(largest(specular), 1.0f);
    material.roughness = roughnessOfExponent(numberOf(source, AI_MATKEY_SHININESS, 0.0f));
    const float ior = numberOf(source, AI_MATKEY_REFRACTI, 1.5f);
    material.ior = ior > 1.0f ? ior : 1.5f;
    readTextures(source, material);
    const float opacity = std::clamp(numberOf(source, AI_MATKEY_OPACITY, 1.0f), 0.0f, 1.0f);
    material.alpha = opacity;
    if (opacity < 1.0f && material.alphaMode == AlphaMode::opaque) material.alphaMode = AlphaMode::blend;
    readIllumination(source, opacity, specular, material);
    if (material.transmission > 0.0f) material.alpha = 1.0f;
    float roughness = 0.0f, metallic = 0.0f;
    const bool isPhysical = source.material.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == aiReturn_SUCCESS ||
                            source.material.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == aiReturn_SUCCESS;
    if (!isPhysical) material.phong = phongOf(source, specular, material);
    material.roughness = std::clamp(numberOf(source, AI_MATKEY_ROUGHNESS_FACTOR, material.roughness), 0.0f, 1.0f);
    material.metallic = std::clamp(numberOf(source, AI_MATKEY_METALLIC_FACTOR, material.metallic), 0.0f, 1.0f);
    return material;
}

}  // namespace

Material defaultMaterial() {
    Material material;
    material.name = "default";
    material.baseColor = glm::vec3(0.8f);
    material.specular = 0.0f;
    return material;
}

void readPhongMaterials(const aiScene& source, const std::filesystem::path& path, TextureRequests& requests,
                        Scene& scene) {
    for (unsigned m = 0; m < source.mNumMaterials; ++m)
        scene.materials.push_back(readMaterial({source, *source.mMaterials[m], path.parent_path(), requests}));
    if (scene.materials.empty()) scene.materials.push_back(defaultMaterial());
}

}  // namespace raylab
