#include "engine/render/gpu_scene.h"

#include "engine/scene/bounds.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

struct TexelBinding {
    uint32_t binding;
    const char* name;
    VkFormat format;
    size_t bytes;
};

constexpr TexelBinding kWords(uint32_t binding, const char* name) { return {binding, name, VK_FORMAT_R32G32B32A32_UINT, 16}; }

constexpr TexelBinding kInstances = kWords(shared::kBindInstances, "instances");
constexpr TexelBinding kTriangles = kWords(shared::kBindTriangles, "triangles");
constexpr TexelBinding kVertices = kWords(shared::kBindVertices, "vertices");
constexpr TexelBinding kQuadrics = kWords(shared::kBindQuadrics, "quadrics");
constexpr TexelBinding kMaterials = kWords(shared::kBindMaterials, "materials");
constexpr TexelBinding kPhong = kWords(shared::kBindPhong, "Phong materials");
constexpr TexelBinding kTextures = kWords(shared::kBindTextures, "textures");
constexpr TexelBinding kTexels = {shared::kBindTexels, "texels", VK_FORMAT_R32_UINT, 4};
constexpr TexelBinding kEmissive = kWords(shared::kBindEmissive, "emissive triangles");
constexpr TexelBinding kPunctual = kWords(shared::kBindPunctual, "punctual lights");
constexpr TexelBinding kEnvironment = {shared::kBindEnvironment, "environment", VK_FORMAT_R32G32B32A32_SFLOAT, 16};
constexpr TexelBinding kAlias = {shared::kBindEnvironmentAlias, "environment alias table", VK_FORMAT_R32G32_UINT, 8};

}  // namespace

GpuScene::GpuScene(Device& device, const Scene& scene, LightChoice lightChoice) {
    const auto add = [&](const TexelBinding& b, const auto& data) {
        buffers_.push_back(
            {b.binding, makeTexelBuffer(device, b.name, std::as_bytes(std::span(data)), b.format, b.bytes)});
    };
    const Bounds bounds = sceneBounds(scene);
    diagonal_ = glm::length(bounds.hi - bounds.lo);
    MaterialTables materials = packMaterials(scene);
    lights_ = packLights(scene, 0.5f * diagonal_, materials, lightChoice);
    {
        const GeometryData geometry = packGeometry(scene);
        add(kInstances, geometry.instances);
        add(kTriangles, geometry.triangles);
        add(kVertices, geometry.vertices);
        add(kQuadrics, geometry.quadrics);
    }
    add(kMaterials, materials.materials);
    add(kPhong, packPhong(scene));
    add(kTextures, materials.textures);
    add(kTexels, materials.texels);
    add(kEmissive, lights_.emissive);
    add(kPunctual, lights_.punctual);
    add(kEnvironment, lights_.environment);
    add(kAlias, lights_.environmentAlias);
    emissiveCount_ = static_cast<uint32_t>(lights_.emissive.size());
    punctualCount_ = static_cast<uint32_t>(lights_.punctual.size());
    lights_.emissive = {};
    lights_.punctual = {};
    lights_.environment = {};
    lights_.environmentAlias = {};
}

std::vector<BindingInfo> GpuScene::bindings() {
    std::vector<BindingInfo> infos;
    for (const TexelBinding& b : {kInstances, kTriangles, kVertices, kQuadrics, kMaterials, kPhong, kTextures, kTexels, kEmissive, kPunctual,
                                  kEnvironment, kAlias})
        infos.push_back({b.binding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER});
    return infos;
}

void GpuScene::bind(const Device& device, const KernelLayout& layout) const {
    for (const Bound& bound : buffers_) bindTexelView(device, layout, bound.binding, bound.texels.view.get());
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
    frame.sceneDiagonal = diagonal_;
}

size_t GpuScene::memoryBytes() const {
    size_t total = 0;
    for (const Bound& bound : buffers_) total += bound.texels.buffer.sizeBytes();
    return total;
}

}  // namespace raylab
