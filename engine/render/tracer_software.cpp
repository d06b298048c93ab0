#include "engine/render/tracer_software.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/render/triangle_record.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

constexpr std::string_view kBrute = "brute";
/// Of a tracer that walks no tree: any whose triangles are apart from the nodes.
constexpr std::string_view kBruteLayout = "bvh2q";

constexpr std::array kTracers = {
    TracerInfo{"software", "BVH in the compute shader", "render_software.comp.spv", "rays_software.comp.spv"},
    TracerInfo{kBrute, "every triangle, no BVH", "render_brute.comp.spv", "rays_brute.comp.spv"},
};

TexelBuffer makeWords(Device& device, const std::string& name, std::span<const std::byte> bytes) {
    return makeTexelBuffer(device, name, bytes, VK_FORMAT_R32G32B32A32_UINT, 16);
}

}  // namespace

TraceConfig SoftwareTracer::adapt(TraceConfig config) const {
    if (info_.name == kBrute) config.layout = kBruteLayout;
    return config;
}

void SoftwareTracer::build(Device& device, const Scene& scene, const TraceConfig& config) {
    Stopwatch watch;
    layout_ = static_cast<uint32_t>(&findLayout(config.layout) - layouts().data());
    triangleTest_ = findTriangleTest(config.triangle);
    data_ = buildTraceData(scene, config);
    buildSeconds_ = watch.restart();
    nodes_ = makeWords(device, "BVH nodes", std::as_bytes(std::span(data_.nodes)));
    const std::vector<glm::uvec4> packed = layouts()[layout_].blocks ? std::vector<glm::uvec4>() : packTriangles();
    triangles_ = makeWords(device, "traversal triangles", std::as_bytes(std::span(packed)));
    instances_ = makeWords(device, "traversal instances", std::as_bytes(std::span(data_.instances)));
    uploadSeconds_ = watch.restart();
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
    return {{shared::kBindNodes, type}, {shared::kBindTraceTriangles, type}, {shared::kBindTraceInstances, type}};
}

void SoftwareTracer::bind(const Device& device, const KernelLayout& layout) const {
    bindTexelView(device, layout, shared::kBindNodes, nodes_.view.get());
    bindTexelView(device, layout, shared::kBindTraceTriangles, triangles_.view.get());
    bindTexelView(device, layout, shared::kBindTraceInstances, instances_.view.get());
}

std::vector<SpecConstant> SoftwareTracer::constants() const {
    return {{shared::kSpecStackSize, data_.stackEntries}, {shared::kSpecLayout, layout_}, {shared::kSpecTriangle, triangleTest_}};
}

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
