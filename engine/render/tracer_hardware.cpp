#include "engine/render/tracer_hardware.h"

#include <algorithm>
#include <cmath>

#include "engine/accel/halving_order.h"
#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/render/kernel_file.h"
#include "engine/scene/instance_motion.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

constexpr uint32_t kTriangleHitGroup = 0;
constexpr uint32_t kQuadricHitGroup = 1;
constexpr size_t kMostInstances = size_t{1} << (24 - shared::kStructureKindBits);  // a custom index has 24 bits

bool isQuadric(const shared::TraceTriangle& slot) { return (slot.instance & shared::kSlotIsQuadric) != 0; }
bool isOpaque(const shared::TraceTriangle& slot) { return slot.opacity == shared::kAllOpaque; }

bool isInvertible(const shared::TraceInstance& instance) {
    const glm::vec4 sum = instance.worldToObject0 + instance.worldToObject1 + instance.worldToObject2;
    return std::isfinite(sum.x + sum.y + sum.z + sum.w);
}

TexelBuffer makeWords(Device& device, const char* name, std::span<const std::byte> bytes, VkBufferUsageFlags usage) {
    return makeTexelBuffer(device, name, bytes, VK_FORMAT_R32G32B32A32_UINT, sizeof(glm::uvec4), usage);
}

VkTransformMatrixKHR transformMatrix(const glm::mat4& matrix) {
    VkTransformMatrixKHR result{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) result.matrix[row][column] = matrix[column][row];
    return result;
}

}  // namespace

TraceConfig HardwareTracer::adapt(TraceConfig config) const {
    config.layout.clear();
    return config;
}

void HardwareTracer::build(Device& device, const Scene& scene, const TraceConfig& config,
                            const BuildControl& control) {
    if (std::ranges::any_of(scene.instances, moves))
        throw Error("instances of " + scene.name +
                    " move while the shutter is open, and the driver's structures stand still");
    Stopwatch watch;
    data_ = buildTraceData(scene, config, control);
    sortSlots();
    describeInstances();
    buildSeconds_ = watch.restart();
    uploadSlots(device);
    instances_ = makeWords(device, "traversal instances", std::as_bytes(std::span(data_.instances)), 0);
    uploadSeconds_ = watch.restart();
    bottom_ = BottomLevels(device, geometries(device), false);
    buildTopLevel(device, scene);
    buildSeconds_ += watch.restart();
}

void HardwareTracer::uploadSlots(Device& device) {
    triangles_ =
        makeWords(device, "traversal triangles", std::as_bytes(std::span(data_.triangles)), kStructureInputUsage);
    quadrics_ = makeWords(device, "traversal quadrics", std::as_bytes(std::span(data_.quadrics)), 0);
    std::vector<VkAabbPositionsKHR> boxes;
    for (const shared::TraceTriangle& slot : data_.triangles) {
        if (!isQuadric(slot)) continue;
        const Aabb& box = data_.quadricBounds[glm::floatBitsToUint(slot.p0.x)];
        boxes.push_back({box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z});
    }
    boxes_ = makeDeviceBuffer(device, "boxes of quadrics", std::as_bytes(std::span(boxes)), kStructureInputUsage);
}

void HardwareTracer::update(Device& device, const Scene& scene, const TraceConfig& config, const SceneChange& change) {
    updateTraceData(data_, scene, config, change);
    if (!change.meshes.empty()) {
        uploadSlots(device);
        updateStructures(device, change.meshes);
    }
    describeInstances();
    instances_ = makeWords(device, "traversal instances", std::as_bytes(std::span(data_.instances)), 0);
    buildTopLevel(device, scene);
}

void HardwareTracer::updateStructures(Device& device, const std::vector<uint32_t>& meshes) {
    const std::vector<StructureGeometries> all = geometries(device);
    for (size_t i = 0; i < data_.trees.size(); ++i) {
        if (std::ranges::count(meshes, data_.trees[i].mesh) == 0) continue;
        for (const std::optional<size_t>& structure : {slots_[i].opaqueTriangles, slots_[i].alphaTriangles})
            if (structure) updateStructure(device, *structure, all[*structure]);
    }
}

void HardwareTracer::updateStructure(Device& device, size_t structure, const StructureGeometries& geometries) {
    const auto known = deforming_.find(structure);
    if (known != deforming_.end())
        known->second.update(device, 0, geometries);
    else
        deforming_.emplace(structure, BottomLevels(device, std::span(&geometries, 1), true));
}

VkDeviceAddress HardwareTracer::structureAddress(size_t structure) const {
    const auto deforming = deforming_.find(structure);
    return deforming != deforming_.end() ? deforming->second.address(0) : bottom_.address(structure);
}

/// Orders the slots of each tree: opaque triangles, other triangles, quadrics, and each kind as halvingOrder() has it.
void HardwareTracer::sortSlots() {
    slots_.clear();
    uint32_t boxes = 0;
    for (PrimitiveTree& tree : data_.trees) {
        std::vector<uint32_t> bySlot[3];
        for (uint32_t i = 0; i < tree.slotCount; ++i) {
            const shared::TraceTriangle& slot = data_.triangles[tree.firstSlot + i];
            bySlot[isQuadric(slot) ? 2 : isOpaque(slot) ? 0 : 1].push_back(i);
        }
        reorder(tree, bySlot);
        TreeSlots slots;
        slots.opaque = static_cast<uint32_t>(bySlot[0].size());
        slots.alpha = static_cast<uint32_t>(bySlot[1].size());
        slots.quadrics = static_cast<uint32_t>(bySlot[2].size());
        slots.firstBox = boxes;
        boxes += slots.quadrics;
        slots_.push_back(slots);
    }
}

Aabb HardwareTracer::slotBounds(const shared::TraceTriangle& slot) const {
    if (isQuadric(slot)) return data_.quadricBounds[glm::floatBitsToUint(slot.p0.x)];
    return {glm::min(slot.p0, glm::min(slot.p1, slot.p2)), glm::max(slot.p0, glm::max(slot.p1, slot.p2))};
}

/// The tree's own order follows, so that an update writes the slots in the new one.
void HardwareTracer::reorder(PrimitiveTree& tree, std::span<const std::vector<uint32_t>> kinds) {
    const auto first = data_.triangles.begin() + tree.firstSlot;
    const std::vector<shared::TraceTriangle> old(first, first + tree.slotCount);
    const std::vector<uint32_t> oldOrder = tree.bvh.order;
    uint32_t at = 0;
    for (const std::vector<uint32_t>& kind : kinds) {
        std::vector<Aabb> bounds(kind.size());
        std::ranges::transform(kind, bounds.begin(), [&](uint32_t i) { return slotBounds(old[i]); });
        for (const uint32_t i : halvingOrder(bounds)) {
            first[at] = old[kind[i]];
            tree.bvh.order[at++] = oldOrder[kind[i]];
        }
    }
}

/// Where a shader finds the slot of a primitive below an instance.
void HardwareTracer::describeInstances() {
    for (shared::TraceInstance& instance : data_.instances) {
        const TreeSlots& slots = slots_[data_.treeAtSlot(instance.firstSlot)];
        instance.opaqueSlots = slots.opaque;
        instance.triangleSlots = slots.opaque + slots.alpha;
    }
}

std::vector<StructureGeometries> HardwareTracer::geometries(const Device& device) {
    const VkDeviceAddress triangles = addressOf(device, triangles_.buffer);
    const VkDeviceAddress boxes = addressOf(device, boxes_);
    std::vector<StructureGeometries> structures;
    for (size_t i = 0; i < slots_.size(); ++i) {
        TreeSlots& slots = slots_[i];
        const VkDeviceAddress first = triangles + sizeof(shared::TraceTriangle) * data_.trees[i].firstSlot;
        if (slots.opaque > 0) {
            slots.opaqueTriangles = structures.size();
            structures.push_back({{first, slots.opaque, false, true}});
        }
        if (slots.alpha > 0) {
            slots.alphaTriangles = structures.size();
            const VkDeviceAddress firstAlpha = first + sizeof(shared::TraceTriangle) * slots.opaque;
            structures.push_back({{firstAlpha, slots.alpha, false, false}});
        }
        if (slots.quadrics > 0) {
            slots.boxes = structures.size();
            const VkDeviceAddress firstBox = boxes + sizeof(VkAabbPositionsKHR) * slots.firstBox;
            structures.push_back({{firstBox, slots.quadrics, true, false}});
        }
    }
    return structures;
}

void HardwareTracer::buildTopLevel(Device& device, const Scene& scene) {
    if (data_.instances.size() > kMostInstances)
        throw Error(scene.name + ": " + std::to_string(data_.instances.size()) +
                    " instances, but the driver's structures number at most " + std::to_string(kMostInstances));
    std::vector<VkAccelerationStructureInstanceKHR> instances;
    for (uint32_t i = 0; i < data_.instances.size(); ++i) {
        const shared::TraceInstance& record = data_.instances[i];
        if (!isInvertible(record)) continue;
        const TreeSlots& slots = slots_[data_.treeAtSlot(record.firstSlot)];
        const bool moved = record.instance != shared::kInheritInstance;
        VkAccelerationStructureInstanceKHR instance{};
        instance.transform = transformMatrix(moved ? scene.instances[record.instance].objectToWorld : glm::mat4(1.0f));
        instance.mask = 0xff;
        instance.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR & 0xffu;
        const auto add = [&](const std::optional<size_t>& structure, uint32_t kind, uint32_t hitGroup) {
            if (!structure) return;
            instance.instanceCustomIndex = (i << shared::kStructureKindBits | kind) & 0xffffffu;
            instance.accelerationStructureReference = structureAddress(*structure);
            instance.instanceShaderBindingTableRecordOffset = hitGroup & 0xffffffu;
            instances.push_back(instance);
        };
        add(slots.opaqueTriangles, shared::kStructureOpaque, kTriangleHitGroup);
        add(slots.alphaTriangles, shared::kStructureAlpha, kTriangleHitGroup);
        add(slots.boxes, shared::kStructureQuadrics, kQuadricHitGroup);
    }
    top_.build(device, instances);
}

std::vector<BindingInfo> HardwareTracer::bindings() const {
    constexpr VkDescriptorType type = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    return {{shared::kBindTraceTriangles, type},
            {shared::kBindTraceQuadrics, type},
            {shared::kBindTraceInstances, type},
            {shared::kBindTopLevel, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR}};
}

void HardwareTracer::bind(const Device& device, const KernelLayout& layout) const {
    bindTexelView(device, layout, shared::kBindTraceTriangles, triangles_.view.get());
    bindTexelView(device, layout, shared::kBindTraceQuadrics, quadrics_.view.get());
    bindTexelView(device, layout, shared::kBindTraceInstances, instances_.view.get());
    bindStructure(device, layout, shared::kBindTopLevel, top_.get());
}

void HardwareTracer::writeFrame(shared::FrameParams& frame) const {
    frame.traceInstanceCount = static_cast<uint32_t>(data_.instances.size());
}

size_t HardwareTracer::structureBytes() const {
    size_t total = bottom_.memoryBytes() + top_.memoryBytes();
    for (const auto& [structure, levels] : deforming_) total += levels.memoryBytes();
    return total;
}

size_t HardwareTracer::memoryBytes() const {
    return triangles_.buffer.sizeBytes() + quadrics_.buffer.sizeBytes() + instances_.buffer.sizeBytes() +
           boxes_.sizeBytes() + structureBytes();
}

Kernel QueryTracer::makeKernel(Device& device, const KernelLayout& layout, KernelKind kind,
                               std::vector<SpecConstant> constants) const {
    return makeComputeKernel(device, layout, kernelFile(kind, "query.comp"), constants);
}

VkShaderStageFlags PipelineTracer::stages() const {
    return VK_SHADER_STAGE_RAYGEN_BIT_KHR | VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR | VK_SHADER_STAGE_ANY_HIT_BIT_KHR |
           VK_SHADER_STAGE_INTERSECTION_BIT_KHR | VK_SHADER_STAGE_MISS_BIT_KHR;
}

Kernel PipelineTracer::makeKernel(Device& device, const KernelLayout& layout, KernelKind kind,
                                  std::vector<SpecConstant> constants) const {
    RayTracingStages stages;
    stages.raygen = shaderFile(kernelPrefix(kind) + ".rgen");
    stages.miss = {shaderFile("closest.rmiss"), shaderFile("shadow.rmiss")};
    stages.hit = {{shaderFile("triangle.rchit"), shaderFile("triangle.rahit"), {}},
                  {shaderFile("quadric.rchit"), shaderFile("quadric.rahit"), shaderFile("quadric.rint")}};
    return makeRayTracingKernel(device, layout, stages, shared::kWorkgroupSize, constants);
}

}  // namespace raylab
