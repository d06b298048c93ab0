#pragma once

#include <map>
#include <optional>

#include "engine/gpu/acceleration_structure.h"
#include "engine/render/tracer.h"

namespace raylab {

/// The traversal is the driver's, over bottom-level structures of a mesh each (or of the merged meshes: TreePlan) and a
/// top-level structure over instances. Primitives and instances are handed over in halvingOrder(), because there are
/// drivers that build over the order as it is; a slot's record says which primitive it is. Of a tree's slots come first
/// the triangles that are opaque everywhere, then those that may need an alpha test, then quadrics: a structure each.
class HardwareTracer : public Tracer {
public:
    explicit HardwareTracer(const TracerInfo& info) : info_(info) {}
    const TracerInfo& info() const override { return info_; }
    TraceConfig adapt(TraceConfig config) const override;
    /// Throws Error also where the driver cannot build the structures.
    void build(Device& device, const Scene& scene, const TraceConfig& config, const BuildControl& control) override;
    /// Moved instances: the top-level structure alone is built anew. A mesh that changes gets a bottom-level structure
    /// of its own that can be updated, and from then on is.
    void update(Device& device, const Scene& scene, const TraceConfig& config, const SceneChange& change) override;
    std::vector<BindingInfo> bindings() const override;
    void bind(const Device& device, const KernelLayout& layout) const override;
    void writeFrame(shared::FrameParams& frame) const override;
    const TraceData& traceData() const override { return data_; }
    size_t memoryBytes() const override;
    /// Of what the driver built.
    size_t structureBytes() const;
    double buildSeconds() const override { return buildSeconds_; }
    double uploadSeconds() const override { return uploadSeconds_; }

private:
    /// The slots of a tree by kind, and the structures over them.
    struct TreeSlots {
        uint32_t opaque = 0, alpha = 0, quadrics = 0;
        uint32_t firstBox = 0;                                         ///< among all boxes
        std::optional<size_t> opaqueTriangles, alphaTriangles, boxes;  ///< structures
    };

    void sortSlots();
    Aabb slotBounds(const shared::TraceTriangle& slot) const;
    void reorder(PrimitiveTree& tree, std::span<const std::vector<uint32_t>> kinds);
    void describeInstances();
    void uploadSlots(Device& device);
    std::vector<StructureGeometries> geometries(const Device& device);
    void updateStructures(Device& device, const std::vector<uint32_t>& meshes);
    void updateStructure(Device& device, size_t structure, const StructureGeometries& geometries);
    VkDeviceAddress structureAddress(size_t structure) const;
    void buildTopLevel(Device& device, const Scene& scene);

    TracerInfo info_;
    TraceData data_;
    std::vector<TreeSlots> slots_;  ///< of each of data_.trees
    TexelBuffer triangles_, quadrics_, instances_;
    Buffer boxes_;
    BottomLevels bottom_;
    std::map<size_t, BottomLevels> deforming_;  ///< in place of those in bottom_
    TopLevel top_;
    double buildSeconds_ = 0.0;
    double uploadSeconds_ = 0.0;
};

/// VK_KHR_ray_query in compute kernels.
class QueryTracer : public HardwareTracer {
public:
    using HardwareTracer::HardwareTracer;
    VkShaderStageFlags stages() const override { return VK_SHADER_STAGE_COMPUTE_BIT; }
    Kernel makeKernel(Device& device, const KernelLayout& layout, KernelKind kind,
                      std::vector<SpecConstant> constants) const override;
};

/// VK_KHR_ray_tracing_pipeline, called from the ray generation shader alone.
class PipelineTracer : public HardwareTracer {
public:
    using HardwareTracer::HardwareTracer;
    VkShaderStageFlags stages() const override;
    Kernel makeKernel(Device& device, const KernelLayout& layout, KernelKind kind,
                      std::vector<SpecConstant> constants) const override;
};

}  // namespace raylab
