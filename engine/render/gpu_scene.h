#pragma once

#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/gpu_data.h"
#include "engine/scene/bounds.h"
#include "shaders/shared/frame.h"

namespace raylab {

/// A scene on the device, apart from what a tracer builds: geometry for shading, materials, textures, lights.
class GpuScene {
public:
    GpuScene(Device& device, const Scene& scene, const LightConfig& lightConfig);

    static std::vector<BindingInfo> bindings();
    void bind(const Device& device, const KernelLayout& layout) const;
    /// The fields of lights and of the environment.
    void writeFrame(shared::FrameParams& frame) const;
    bool hasLightTree() const { return hasLightTree_; }
    /// Of all that it shows, in world space.
    const Bounds& bounds() const { return bounds_; }
    size_t memoryBytes() const;

private:
    float diagonal() const { return glm::length(bounds_.hi - bounds_.lo); }

    struct Bound {
        uint32_t binding;
        TexelBuffer texels;
    };
    std::vector<Bound> buffers_;
    LightTables lights_;  ///< arrays emptied after the upload
    uint32_t emissiveCount_ = 0;
    uint32_t punctualCount_ = 0;
    bool hasLightTree_ = false;
    Bounds bounds_;
};

}  // namespace raylab
