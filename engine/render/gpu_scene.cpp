#include "engine/render/gpu_scene.h"

#include <algorithm>

#include "engine/render/directional_albedo.h"
#include "engine/scene/bounds.h"
#include "shaders/shared/bindings.h"

namespace raylab {

/// Where a buffer is bound, and as what.
struct TexelBinding {
    uint32_t binding;
    const char* name;
    VkFormat format;
    size_t bytes;
};

namespace {

constexpr TexelBinding kWords(uint32_t binding, const char* name) { return {binding, name, VK_FORMAT_R32G32B32A32_UINT, 16}; }

constexpr TexelBinding kInstances = kWords(shared::kBindInstances, "instances");
constexpr TexelBinding kMotion = kWords(shared::kBindMotion, "motion of instances");
constexpr TexelBinding kTriangles = kWords(shared::kBindTriangles, "triangles");
constexpr TexelBinding kVertices = kWords(shared::kBindVertices, "vertices");
constexpr TexelBinding kQuadrics = kWords(shared::kBindQuadrics, "quadrics");
constexpr TexelBinding kMaterials = kWords(shared::kBindMaterials, "materials");
constexpr TexelBinding kPhong = kWords(shared::kBindPhong, "Phong materials");
constexpr TexelBinding kAlbedo = kWords(shared::kBindAlbedo, "directional albedos");
constexpr TexelBinding kLobes = kWords(shared::kBindLobes, "lobes of materials");
constexpr TexelBinding kLobeTextures = kWords(shared::kBindLobeTextures, "textures of lobes");
constexpr TexelBinding kTextures = kWords(shared::kBindTextures, "textures");
constexpr TexelBinding kTexels = {shared::kBindTexels, "texels", VK_FORMAT_R32_UINT, 4};
constexpr TexelBinding kEmissive = kWords(shared::kBindEmissive, "emissive triangles");
constexpr TexelBinding kPunctual = kWords(shared::kBindPunctual, "punctual lights");
constexpr TexelBinding kLightNodes = kWords(shared::kBindLightNodes, "light tree");
constexpr TexelBinding kLightTrails = {shared::kBindLightTrails, "light trails", VK_FORMAT_R32G32_UINT, 8};
constexpr TexelBinding kEnvironment = {shared::kBindEnvironment, "environment", VK_FORMAT_R32G32B32A32_SFLOAT, 16};
constexpr TexelBinding kAlias = {shared::kBindEnvironmentAlias, "environment alias table", VK_FORMAT_R32G32_UINT, 8};

bool hasSheen(const Material& m) { return m.sheenColor != glm::vec3(0.0f); }

bool hasGgx(const Material& m) {
    return m.metallic > 0.0f || m.specular > 0.0f || m.clearcoat > 0.0f || m.transmission > 0.0f;
}

/// The tables that the scene's materials are shaded by, made once, and only where something is: black ones serve kernels
/// that contain what no material has.
std::vector<glm::uvec4> albedoTables(const Scene& scene) {
    if (std::ranges::none_of(scene.materials, hasGgx) && std::ranges::none_of(scene.materials, hasSheen))
        return std::vector<glm::uvec4>(size_t{shared::kAlbedoCells} * (shared::kAlbedoCells + 1), glm::uvec4(0u));
    static const std::vector<glm::uvec4> ggx = makeAlbedoTable();
    std::vector<glm::uvec4> words = ggx;
    if (std::ranges::any_of(scene.materials, hasSheen)) {
        static const std::vector<glm::uvec4> sheen = makeSheenTable();
        words.insert(words.end(), sheen.begin(), sheen.end());
    }
    return words;
}

}  // namespace

/// Writes a buffer where its bytes are others than those it has; another buffer where their number is.
template <class Item>
void GpuScene::put(Device& device, const TexelBinding& what, const std::vector<Item>& items) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(items));
    const Hash128 content = hashBytes(bytes);
    const auto known = buffers_.find(what.binding);
    const bool fits = known != buffers_.end() && known->second.sizeBytes == bytes.size();
    if (fits && known->second.content == content) return;
    if (fits) {
        upload(device, known->second.texels.buffer, bytes);
        known->second.content = content;
    } else {
        buffers_[what.binding] = {makeTexelBuffer(device, what.name, bytes, what.format, what.bytes), bytes.size(),
                                  content};
    }
    uploadedBytes_ += bytes.size();
}

void GpuScene::update(Device& device, const Scene& scene, const LightConfig& lightConfig, const SceneParts& changed) {
    if (changed.geometry || changed.instances) bounds_ = sceneBounds(scene);
    MaterialTables materials;
    if (changed.textures) {
        materials = packMaterials(scene);
        textureMeans_ = materials.means;
    } else {
        materials.materials = packMaterialData(scene);
        materials.means = textureMeans_;
    }
    lights_ = packLights(scene, 0.5f * diagonal(), materials, lightConfig, changed.environment ? nullptr : &lights_);
    putGeometry(device, scene, changed);
    putSurfaces(device, scene, materials, changed);
    putLights(device, changed);
}

void GpuScene::putGeometry(Device& device, const Scene& scene, const SceneParts& changed) {
    GeometryData geometry;
    if (changed.geometry)
        geometry = packGeometry(scene);
    else
        geometry.instances = packInstances(scene);
    for (size_t i = 0; i < lights_.firstTrail.size(); ++i) geometry.instances[i].firstTrail = lights_.firstTrail[i];
    put(device, kInstances, geometry.instances);
    put(device, kMotion, packMotion(scene));
    if (!changed.geometry) return;
    put(device, kTriangles, geometry.triangles);
    put(device, kVertices, geometry.vertices);
    put(device, kQuadrics, geometry.quadrics);
}

void GpuScene::putSurfaces(Device& device, const Scene& scene, const MaterialTables& materials,
                           const SceneParts& changed) {
    put(device, kMaterials, materials.materials);
    put(device, kPhong, packPhong(scene));
    put(device, kAlbedo, albedoTables(scene));
    put(device, kLobes, packLobes(scene));
    put(device, kLobeTextures, packLobeTextures(scene));
    if (!changed.textures) return;
    put(device, kTextures, materials.textures);
    put(device, kTexels, materials.texels);
}

void GpuScene::putLights(Device& device, const SceneParts& changed) {
    put(device, kEmissive, lights_.emissive);
    put(device, kPunctual, lights_.punctual);
    put(device, kLightNodes, lights_.nodes);
    put(device, kLightTrails, lights_.trails);
    if (changed.environment) {
        put(device, kEnvironment, lights_.environment);
        put(device, kAlias, lights_.environmentAlias);
    }
    emissiveCount_ = static_cast<uint32_t>(lights_.emissive.size());
    punctualCount_ = static_cast<uint32_t>(lights_.punctual.size());
    hasLightTree_ = !lights_.nodes.empty();
    lights_.emissive = {};
    lights_.punctual = {};
    lights_.nodes = {};
    lights_.trails = {};
    lights_.environment = {};
    lights_.environmentAlias = {};
}

std::vector<BindingInfo> GpuScene::bindings() {
    std::vector<BindingInfo> infos;
    for (const TexelBinding& b :
         {kInstances, kMotion,   kTriangles, kVertices, kQuadrics, kMaterials,   kPhong,       kAlbedo,     kLobes,
          kLobeTextures, kTextures, kTexels, kEmissive, kPunctual, kLightNodes, kLightTrails, kEnvironment, kAlias})
        infos.push_back({b.binding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER});
    return infos;
}

void GpuScene::bind(const Device& device, const KernelLayout& layout) const {
    for (const auto& [binding, buffer] : buffers_) bindTexelView(device, layout, binding, buffer.texels.view.get());
}

void GpuScene::writeFrame(shared::FrameParams& frame) const {
    frame.emissiveCount = emissiveCount_;
    frame.punctualCount = punctualCount_;
    frame.environmentWidth = lights_.environmentWidth;
    frame.environmentHeight = lights_.environmentHeight;
    frame.environmentConstant = lights_.environmentConstant;
    frame.shareEmissive = lights_.shareEmissive;
    frame.sharePunctual = lights_.sharePunctual;
    frame.shareEnvironment = lights_.shareEnvironment;
    frame.emissiveTotal = lights_.emissiveTotal;
    frame.shapedCount = lights_.shapedCount;
    frame.sunDiscCount = lights_.sunDiscCount;
    frame.lightGridOrigin = lights_.gridOrigin;
    frame.lightGridStep = lights_.gridStep;
    frame.sceneDiagonal = diagonal();
}

size_t GpuScene::memoryBytes() const {
    size_t total = 0;
    for (const auto& [binding, buffer] : buffers_) total += buffer.texels.buffer.sizeBytes();
    return total;
}

}  // namespace raylab
