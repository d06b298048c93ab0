#pragma once

#include "engine/render/tracer.h"

namespace raylab {

/// The tracers whose traversal is our own GLSL over buffers. `software` walks the trees; `brute` reads the same triangles and
/// no tree.
class SoftwareTracer : public Tracer {
public:
    explicit SoftwareTracer(const TracerInfo& info) : info_(info) {}
    const TracerInfo& info() const override { return info_; }
    TraceConfig adapt(TraceConfig config) const override;
    void build(Device& device, const Scene& scene, const TraceConfig& config) override;
    std::vector<BindingInfo> bindings() const override;
    void bind(const Device& device, const KernelLayout& layout) const override;
    std::vector<SpecConstant> constants() const override;
    void writeFrame(shared::FrameParams& frame) const override;
    const TraceData* traceData() const override { return &data_; }
    size_t memoryBytes() const override;
    double buildSeconds() const override { return buildSeconds_; }
    double uploadSeconds() const override { return uploadSeconds_; }

private:
    std::vector<glm::uvec4> packTriangles() const;

    TracerInfo info_;
    uint32_t layout_ = 0;        ///< kLayout...
    uint32_t triangleTest_ = 0;  ///< kTriangle...
    TraceData data_;
    TexelBuffer nodes_, triangles_, instances_;
    double buildSeconds_ = 0.0;
    double uploadSeconds_ = 0.0;
};

}  // namespace raylab
