#pragma once

#include "engine/render/tracer.h"

namespace raylab {

/// The traversal is our own GLSL over buffers: a walk of the trees in the layout that the config names.
class SoftwareTracer : public Tracer {
public:
    explicit SoftwareTracer(const TracerInfo& info) : info_(info) {}
    const TracerInfo& info() const override { return info_; }
    TraceConfig adapt(TraceConfig config) const override { return config; }
    void build(Device& device, const Scene& scene, const TraceConfig& config, const BuildControl& control) override;
    void update(Device& device, const Scene& scene, const TraceConfig& config, const SceneChange& change) override;
    std::vector<BindingInfo> bindings() const override;
    void bind(const Device& device, const KernelLayout& layout) const override;
    VkShaderStageFlags stages() const override { return VK_SHADER_STAGE_COMPUTE_BIT; }
    Kernel makeKernel(Device& device, const KernelLayout& layout, KernelKind kind,
                      std::vector<SpecConstant> constants) const override;
    void writeFrame(shared::FrameParams& frame) const override;
    const TraceData& traceData() const override { return data_; }
    size_t memoryBytes() const override;
    double buildSeconds() const override { return buildSeconds_; }
    double uploadSeconds() const override { return uploadSeconds_; }

private:
    std::vector<glm::uvec4> packTriangles() const;
    void uploadNodes(Device& device);
    void uploadSlots(Device& device);

    TracerInfo info_;
    std::string traversal_;      ///< names the kernels' files
    uint32_t triangleTest_ = 0;  ///< kTriangle...
    uint32_t slabTest_ = 0;      ///< kSlab...
    TraceData data_;
    bool blocks_ = false;  ///< triangles stand among the nodes
    TexelBuffer nodes_, triangles_, quadrics_, instances_;
    double buildSeconds_ = 0.0;
    double uploadSeconds_ = 0.0;
};

/// Reads the same triangles and no tree.
class BruteTracer : public SoftwareTracer {
public:
    using SoftwareTracer::SoftwareTracer;
    TraceConfig adapt(TraceConfig config) const override;
};

}  // namespace raylab
