#include "engine/render/tracer_software.h"

#include <array>

#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

constexpr std::array kTracers = {
    TracerInfo{"software", "BVH in the compute shader", "render_software.comp.spv", "rays_software.comp.spv"},
    TracerInfo{"brute", "every triangle, no BVH", "render_brute.comp.spv", "rays_brute.comp.spv"},
};

TexelBuffer makeWords(Device& device, const std::string& name, std::span<const std::byte> bytes) {
    return makeTexelBuffer(device, name, bytes, VK_FORMAT_R32G32B32A32_UINT, 16);
}

}  // namespace

void SoftwareTracer::build(Device& device, const Scene& scene, const BvhConfig& config) {
    Stopwatch watch;
    data_ = buildTraceData(scene, config);
    buildSeconds_ = watch.restart();
    nodes_ = makeWords(device, "BVH nodes", std::as_bytes(std::span(data_.nodes)));
    triangles_ = makeWords(device, "traversal triangles", std::as_bytes(std::span(data_.triangles)));
    instances_ = makeWords(device, "traversal instances", std::as_bytes(std::span(data_.instances)));
    uploadSeconds_ = watch.restart();
}

std::vector<BindingInfo> SoftwareTracer::bindings() const {
    constexpr VkDescriptorType type = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    return {{shared::kBindNodes, type}, {shared::kBindTraceTriangles, type}, {shared::kBindTraceInstances, type}};
}

void SoftwareTracer::bind(const Device& device, const KernelLayout& layout) const {
    bindTexelView(device, layout, shared::kBindNodes, nodes_.view.get());
    bindTexelView(device, layout, shared::kBindTraceTriangles, triangles_.view.get());
    bindTexelView(device, layout, shared::kBindTraceInstances, instances_.view.get());
}

std::vector<SpecConstant> SoftwareTracer::constants() const { return {{shared::kSpecStackSize, data_.stackEntries}}; }

void SoftwareTracer::writeFrame(shared::FrameParams& frame) const {
    frame.root = data_.root;
    frame.hasUpperTree = data_.upper.nodes.empty() ? 0 : 1;
    frame.gridOrigin = data_.grid.origin;
    frame.gridStep = data_.grid.step;
    frame.traceInstanceCount = static_cast<uint32_t>(data_.instances.size());
}

size_t SoftwareTracer::memoryBytes() const {
    return nodes_.buffer.sizeBytes() + triangles_.buffer.sizeBytes() + instances_.buffer.sizeBytes();
}

std::vector<std::string> tracerNames() {
    std::vector<std::string> names;
    for (const TracerInfo& info : kTracers) names.emplace_back(info.name);
    return names;
}

std::unique_ptr<Tracer> makeTracer(std::string_view name) {
    for (const TracerInfo& info : kTracers)
        if (info.name == name) return std::make_unique<SoftwareTracer>(info);
    throw Error("there is no tracer '" + std::string(name) + "'");
}

}  // namespace raylab
