#include "engine/gpu/acceleration_structure.h"

#include <algorithm>
#include <numeric>

#include "engine/core/error.h"
#include "engine/gpu/check.h"

namespace raylab {
namespace {

constexpr VkDeviceSize kStructureAlignment = 256;                 // of its offset in a buffer, by the specification
constexpr VkDeviceSize kScratchOfBatch = VkDeviceSize{64} << 20;  // a structure that wants more is built alone
constexpr double kCompactionPays = 0.9;
constexpr VkDeviceSize kVertexStride = 16;

VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

/// What vkCmdBuildAccelerationStructuresKHR wants to know of one structure; the arrays live here.
struct BuildRecord {
    std::vector<VkAccelerationStructureGeometryKHR> geometries;
    std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
    VkAccelerationStructureBuildGeometryInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
    VkAccelerationStructureBuildSizesInfoKHR sizes{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};

    void settle(const Device& device, VkAccelerationStructureTypeKHR type, VkBuildAccelerationStructureFlagsKHR flags) {
        info.type = type;
        info.flags = flags;
        info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
        info.geometryCount = static_cast<uint32_t>(geometries.size());
        info.pGeometries = geometries.data();
        std::vector<uint32_t> counts;
        for (const VkAccelerationStructureBuildRangeInfoKHR& range : ranges) counts.push_back(range.primitiveCount);
        device.rayTracing().buildSizes(device.get(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info,
                                       counts.data(), &sizes);
    }
};

VkAccelerationStructureGeometryKHR describeGeometry(const StructureGeometry& geometry) {
    VkAccelerationStructureGeometryKHR result{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
    result.flags = geometry.opaque ? VK_GEOMETRY_OPAQUE_BIT_KHR : VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR;
    if (geometry.boxes) {
        result.geometryType = VK_GEOMETRY_TYPE_AABBS_KHR;
        result.geometry.aabbs = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR};
        result.geometry.aabbs.data.deviceAddress = geometry.data;
        result.geometry.aabbs.stride = sizeof(VkAabbPositionsKHR);
        return result;
    }
    result.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    result.geometry.triangles = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR};
    result.geometry.triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    result.geometry.triangles.vertexData.deviceAddress = geometry.data;
    result.geometry.triangles.vertexStride = kVertexStride;
    result.geometry.triangles.maxVertex = 3 * geometry.count - 1;
    result.geometry.triangles.indexType = VK_INDEX_TYPE_NONE_KHR;
    return result;
}

BuildRecord bottomRecord(const Device& device, const StructureGeometries& geometries, bool updatable) {
    BuildRecord record;
    uint64_t total = 0;
    for (const StructureGeometry& geometry : geometries) {
        record.geometries.push_back(describeGeometry(geometry));
        record.ranges.push_back({geometry.count, 0, 0, 0});
        total += geometry.count;
    }
    const uint64_t most = device.rayTracing().structureLimits.maxPrimitiveCount;
    if (total > most)
        throw Error("a mesh of " + std::to_string(total) + " primitives, but " + device.description().name +
                    " builds structures over at most " + std::to_string(most));
    VkBuildAccelerationStructureFlagsKHR flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR |
                                                 VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_COMPACTION_BIT_KHR;
    if (updatable) flags |= VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_UPDATE_BIT_KHR;
    record.settle(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, flags);
    return record;
}

StructureHandle createStructure(const Device& device, const Buffer& memory, VkDeviceSize offset, VkDeviceSize size,
                                VkAccelerationStructureTypeKHR type) {
    VkAccelerationStructureCreateInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
    info.buffer = memory.get();
    info.offset = offset;
    info.size = size;
    info.type = type;
    VkAccelerationStructureKHR object = VK_NULL_HANDLE;
    check(device.rayTracing().createStructure(device.get(), &info, nullptr, &object),
          "vkCreateAccelerationStructureKHR");
    return {device, object};
}

Buffer structureMemory(const Device& device, const char* name, VkDeviceSize bytes) {
    return Buffer(device, name, bytes,
                  VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                  BufferPlace::device);
}

/// Builds records that have their destinations, in one submission.
void runBuilds(Device& device, std::span<BuildRecord* const> records) {
    const VkDeviceSize alignment = device.rayTracing().structureLimits.minAccelerationStructureScratchOffsetAlignment;
    VkDeviceSize scratchBytes = alignment;
    const auto scratchOf = [&](const BuildRecord& record) {
        const bool updates = record.info.mode == VK_BUILD_ACCELERATION_STRUCTURE_MODE_UPDATE_KHR;
        return alignUp(updates ? record.sizes.updateScratchSize : record.sizes.buildScratchSize, alignment);
    };
    for (const BuildRecord* record : records) scratchBytes += scratchOf(*record);
    const Buffer scratch(device, "scratch of acceleration structures", scratchBytes,
                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                         BufferPlace::device);
    VkDeviceAddress at = alignUp(addressOf(device, scratch), alignment);
    std::vector<VkAccelerationStructureBuildGeometryInfoKHR> infos;
    std::vector<const VkAccelerationStructureBuildRangeInfoKHR*> ranges;
    for (BuildRecord* record : records) {
        record->info.scratchData.deviceAddress = at;
        at += scratchOf(*record);
        infos.push_back(record->info);
        ranges.push_back(record->ranges.data());
    }
    device.run("acceleration structures", [&](VkCommandBuffer commands) {
        device.rayTracing().build(commands, static_cast<uint32_t>(infos.size()), infos.data(), ranges.data());
    });
}

void runInBatches(Device& device, std::vector<BuildRecord>& records) {
    std::vector<BuildRecord*> batch;
    VkDeviceSize scratch = 0;
    const auto flush = [&] {
        if (!batch.empty()) runBuilds(device, batch);
        batch.clear();
        scratch = 0;
    };
    for (BuildRecord& record : records) {
        if (scratch + record.sizes.buildScratchSize > kScratchOfBatch) flush();
        batch.push_back(&record);
        scratch += record.sizes.buildScratchSize;
    }
    flush();
}

std::vector<VkDeviceSize> compactedSizes(Device& device, std::span<const StructureHandle> handles) {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR;
    info.queryCount = static_cast<uint32_t>(handles.size());
    VkQueryPool pool = VK_NULL_HANDLE;
    check(vkCreateQueryPool(device.get(), &info, nullptr, &pool), "vkCreateQueryPool");
    const QueryPoolHandle owner(device.get(), pool);
    std::vector<VkAccelerationStructureKHR> structures;
    for (const StructureHandle& handle : handles) structures.push_back(handle.get());
    device.run("compacted sizes", [&](VkCommandBuffer commands) {
        vkCmdResetQueryPool(commands, pool, 0, info.queryCount);
        device.rayTracing().writeProperties(commands, info.queryCount, structures.data(), info.queryType, pool, 0);
    });
    std::vector<VkDeviceSize> sizes(handles.size());
    check(vkGetQueryPoolResults(device.get(), pool, 0, info.queryCount, sizes.size() * sizeof(VkDeviceSize),
                                sizes.data(), sizeof(VkDeviceSize), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
    return sizes;
}

}  // namespace

StructureHandle::StructureHandle(const Device& device, VkAccelerationStructureKHR object)
    : device_(device.get()), destroy_(device.rayTracing().destroyStructure), object_(object) {}

StructureHandle::~StructureHandle() {
    if (object_ != VK_NULL_HANDLE) destroy_(device_, object_, nullptr);
}

BottomLevels::BottomLevels(Device& device, std::span<const StructureGeometries> structures, bool updatable)
    : updatable_(updatable) {
    if (structures.empty()) return;
    std::vector<BuildRecord> records;
    std::vector<VkDeviceSize> sizes;
    for (const StructureGeometries& geometries : structures) {
        records.push_back(bottomRecord(device, geometries, updatable));
        sizes.push_back(records.back().sizes.accelerationStructureSize);
    }
    createStructures(device, sizes);
    builtBytes_ = memory_.sizeBytes();
    for (size_t i = 0; i < records.size(); ++i) records[i].info.dstAccelerationStructure = handles_[i].get();
    runInBatches(device, records);
    compact(device);
    for (const StructureHandle& handle : handles_) {
        VkAccelerationStructureDeviceAddressInfoKHR info{
            VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
        info.accelerationStructure = handle.get();
        addresses_.push_back(device.rayTracing().structureAddress(device.get(), &info));
    }
}

void BottomLevels::createStructures(const Device& device, std::span<const VkDeviceSize> sizes) {
    VkDeviceSize total = 0;
    for (const VkDeviceSize size : sizes) total += alignUp(size, kStructureAlignment);
    memory_ = structureMemory(device, "bottom-level structures", total);
    VkDeviceSize offset = 0;
    for (const VkDeviceSize size : sizes) {
        handles_.push_back(
            createStructure(device, memory_, offset, size, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR));
        offset += alignUp(size, kStructureAlignment);
    }
}

void BottomLevels::compact(Device& device) {
    const std::vector<VkDeviceSize> sizes = compactedSizes(device, handles_);
    VkDeviceSize total = 0;
    for (const VkDeviceSize size : sizes) total += alignUp(size, kStructureAlignment);
    if (static_cast<double>(total) > kCompactionPays * static_cast<double>(builtBytes_)) return;
    const Buffer oldMemory = std::move(memory_);
    const std::vector<StructureHandle> old = std::exchange(handles_, {});
    createStructures(device, sizes);
    device.run("compaction", [&](VkCommandBuffer commands) {
        for (size_t i = 0; i < old.size(); ++i) {
            VkCopyAccelerationStructureInfoKHR copy{VK_STRUCTURE_TYPE_COPY_ACCELERATION_STRUCTURE_INFO_KHR};
            copy.src = old[i].get();
            copy.dst = handles_[i].get();
            copy.mode = VK_COPY_ACCELERATION_STRUCTURE_MODE_COMPACT_KHR;
            device.rayTracing().copy(commands, &copy);
        }
    });
}

void BottomLevels::update(Device& device, size_t index, const StructureGeometries& geometries) {
    if (!updatable_)
        throw Error("a bottom-level structure is updated that was built for good", ExitCode::internalError);
    BuildRecord record = bottomRecord(device, geometries, true);
    record.info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_UPDATE_KHR;
    record.info.srcAccelerationStructure = handles_[index].get();
    record.info.dstAccelerationStructure = handles_[index].get();
    BuildRecord* const one = &record;
    runBuilds(device, std::span(&one, 1));
}

void TopLevel::build(Device& device, std::span<const VkAccelerationStructureInstanceKHR> instances) {
    const uint64_t most = device.rayTracing().structureLimits.maxInstanceCount;
    if (instances.size() > most)
        throw Error(std::to_string(instances.size()) + " instances, but " + device.description().name +
                    " traces at most " + std::to_string(most));
    const std::span<const std::byte> bytes = std::as_bytes(instances);
    const bool again = handle_.get() != VK_NULL_HANDLE && count_ == instances.size();
    if (again)
        upload(device, instances_, bytes);
    else
        instances_ = makeDeviceBuffer(device, "instances of the top-level structure", bytes, kStructureInputUsage);
    BuildRecord record;
    VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
    geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
    geometry.geometry.instances = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR};
    geometry.geometry.instances.data.deviceAddress = addressOf(device, instances_);
    record.geometries = {geometry};
    record.ranges = {{static_cast<uint32_t>(instances.size()), 0, 0, 0}};
    record.settle(device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR,
                  VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR);
    if (!again) {
        handle_ = {};
        memory_ = structureMemory(device, "top-level structure", record.sizes.accelerationStructureSize);
        handle_ = createStructure(device, memory_, 0, record.sizes.accelerationStructureSize,
                                  VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR);
        count_ = instances.size();
    }
    record.info.dstAccelerationStructure = handle_.get();
    BuildRecord* const one = &record;
    runBuilds(device, std::span(&one, 1));
}

}  // namespace raylab
