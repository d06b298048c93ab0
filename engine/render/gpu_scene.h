#pragma once

#include <map>
#include <vector>

#include "engine/core/hash.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/gpu_data.h"
#include "engine/scene/bounds.h"
#include "shaders/shared/frame.h"

namespace raylab {

/// What of a scene may be another than when it was put on the device. Materials and lights always may.
struct SceneParts {
    bool geometry = true;   ///< meshes, apart from which material they wear
    bool instances = true;  ///< which there are, and their matrices
    bool textures = true;
    bool environment = true;  ///< the radiance map
};

struct TexelBinding;

/// A buffer of a scene, and what it was filled with.
struct SceneBuffer {
    TexelBuffer texels;
    size_t sizeBytes = 0;
    Hash128 content;
};

/// A scene on the device, apart from what a tracer builds: geometry for shading, materials, textures, lights.
class GpuScene {
public:
    GpuScene(Device& device, const Scene& scene, const LightConfig& lightConfig) {
        update(device, scene, lightConfig, {});
    }

    /// Packs what may have changed, and uploads those buffers alone whose bytes have. bind() is due again. Where it
    /// throws Error, nothing of this may be used any more.
    void update(Device& device, const Scene& scene, const LightConfig& lightConfig, const SceneParts& changed);

    static std::vector<BindingInfo> bindings();
    void bind(const Device& device, const KernelLayout& layout) const;
    /// The fields of lights and of the environment.
    void writeFrame(shared::FrameParams& frame) const;
    bool hasLightTree() const { return hasLightTree_; }
    /// Of all that it shows, in world space.
    const Bounds& bounds() const { return bounds_; }
    size_t memoryBytes() const;
    /// By all updates so far, the first of all included.
    uint64_t uploadedBytes() const { return uploadedBytes_; }

private:
    float diagonal() const { return glm::length(bounds_.hi - bounds_.lo); }

    template <class Item>
    void put(Device& device, const TexelBinding& what, const std::vector<Item>& items);
    void putGeometry(Device& device, const Scene& scene, const SceneParts& changed);
    void putSurfaces(Device& device, const Scene& scene, const MaterialTables& materials, const SceneParts& changed);
    void putLights(Device& device, const SceneParts& changed);

    std::map<uint32_t, SceneBuffer> buffers_;  ///< by binding
    uint64_t uploadedBytes_ = 0;
    std::vector<uint32_t> textureMeans_;
    LightTables lights_;  ///< arrays emptied after the upload
    uint32_t emissiveCount_ = 0;
    uint32_t punctualCount_ = 0;
    bool hasLightTree_ = false;
    Bounds bounds_;
};

}  // namespace raylab
