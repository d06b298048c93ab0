#include "engine/render/tracer_software.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/gpu/subgroups.h"
#include "engine/render/kernel_file.h"
#include "engine/render/triangle_record.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

TexelBuffer makeWords(Device& device, const std::string& name, std::span<const std::byte> bytes) {
    return makeTexelBuffer(device, name, bytes, VK_FORMAT_R32G32B32A32_UINT, 16);
}

}  // namespace

TraceConfig BruteTracer::adapt(TraceConfig config) const {
    config.layout.clear();
    return config;
}

void SoftwareTracer::build(Device& device, const Scene& scene, const TraceConfig& config,
                            const BuildControl& control) {
    Stopwatch watch;
    blocks_ = !config.layout.empty() && findLayout(config.layout).blocks;
    if (blocks_)
        requireSubgroups(device, VK_SUBGROUP_FEATURE_VOTE_BIT, "--layout " + config.layout, "votes",
                         "use --layout bvh2q, or another device (raylab devices)");
    traversal_ = config.layout.empty() ? std::string(info_.name) : config.layout;
    triangleTest_ = findTriangleTest(config.triangle);
    slabTest_ = config.paddedSlab ? shared::kSlabPadded : shared::kSlabPlain;
    data_ = buildTraceData(scene, config, control);
    buildSeconds_ = watch.restart();
    uploadSlots(device);
    uploadNodes(device);
    uploadSeconds_ = watch.restart();
}

void SoftwareTracer::update(Device& device, const Scene& scene, const TraceConfig& config, const SceneChange& change) {
    updateTraceData(data_, scene, config, change);
    if (!change.meshes.empty()) uploadSlots(device);
    uploadNodes(device);
}

void SoftwareTracer::uploadSlots(Device& device) {
    const std::vector<glm::uvec4> packed = blocks_ ? std::vector<glm::uvec4>() : packTriangles();
    triangles_ = makeWords(device, "traversal triangles", std::as_bytes(std::span(packed)));
    quadrics_ = makeWords(device, "traversal quadrics", std::as_bytes(std::span(data_.quadrics)));
}

void SoftwareTracer::uploadNodes(Device& device) {
    nodes_ = makeWords(device, "BVH nodes", std::as_bytes(std::span(data_.nodes)));
    instances_ = makeWords(device, "traversal instances", std::as_bytes(std::span(data_.instances)));
}

std::vector<glm::uvec4> SoftwareTracer::packTriangles() const {
    const uint32_t words = triangleTests()[triangleTest_].words;
    std::vector<glm::uvec4> packed(data_.triangles.size() * words);
    tbb::parallel_for(size_t{0}, data_.triangles.size(), [&](size_t i) {
        std::copy_n(packTriangle(triangleTest_, data_.triangles[i]).begin(), words, &packed[i * words]);
    });
    return packed;
}

std::vector<BindingInfo> SoftwareTracer::bindings() const {
    constexpr VkDescriptorType type = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    return {{shared::kBindNodes, type},
            {shared::kBindTraceTriangles, type},
            {shared::kBindTraceQuadrics, type},
            {shared::kBindTraceInstances, type}};
}

void SoftwareTracer::bind(const Device& device, const KernelLayout& layout) const {
    bindTexelView(device, layout, shared::kBindNodes, nodes_.view.get());
    bindTexelView(device, layout, shared::kBindTraceTriangles, triangles_.view.get());
    bindTexelView(device, layout, shared::kBindTraceQuadrics, quadrics_.view.get());
    bindTexelView(device, layout, shared::kBindTraceInstances, instances_.view.get());
}

Kernel SoftwareTracer::makeKernel(Device& device, const KernelLayout& layout, KernelKind kind,
                                  std::vector<SpecConstant> constants) const {
    constants.push_back({shared::kSpecStackSize, data_.stackEntries});
    constants.push_back({shared::kSpecTriangle, triangleTest_});
    constants.push_back({shared::kSpecSlab, slabTest_});
    return makeComputeKernel(device, layout, kernelFile(kind, traversal_ + ".comp"), constants);
}

void SoftwareTracer::writeFrame(shared::FrameParams& frame) const {
    frame.root = data_.root;
    frame.hasUpperTree = data_.upper.nodes.empty() ? 0 : 1;
    frame.gridOrigin = data_.grid.origin;
    frame.gridStep = data_.grid.step;
    frame.traceInstanceCount = static_cast<uint32_t>(data_.instances.size());
}

size_t SoftwareTracer::memoryBytes() const {
    return nodes_.buffer.sizeBytes() + triangles_.buffer.sizeBytes() + quadrics_.buffer.sizeBytes() +
           instances_.buffer.sizeBytes();
}

}  // namespace raylab
