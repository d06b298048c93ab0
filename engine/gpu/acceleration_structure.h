#pragma once

#include <span>
#include <vector>

#include "engine/gpu/buffer.h"

namespace raylab {

/// The driver's structure; its memory belongs to whoever made it and must outlive it.
class StructureHandle {
public:
    StructureHandle() = default;
    StructureHandle(const Device& device, VkAccelerationStructureKHR object);
    StructureHandle(StructureHandle&& other) noexcept { swap(other); }
    StructureHandle& operator=(StructureHandle&& other) noexcept {
        StructureHandle(std::move(other)).swap(*this);
        return *this;
    }
    ~StructureHandle();
    VkAccelerationStructureKHR get() const { return object_; }

private:
    void swap(StructureHandle& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(destroy_, other.destroy_);
        std::swap(object_, other.object_);
    }

    VkDevice device_ = VK_NULL_HANDLE;
    PFN_vkDestroyAccelerationStructureKHR destroy_ = nullptr;
    VkAccelerationStructureKHR object_ = VK_NULL_HANDLE;
};

/// Primitives of a bottom-level structure. The order is kept: lavapipe's structure is a tree over it as it is.
struct StructureGeometry {
    VkDeviceAddress data =
        0;  ///< triangles: three times x, y, z and a word that is not read; boxes: VkAabbPositionsKHR
    uint32_t count = 0;
    bool boxes = false;
    bool opaque = true;  ///< no shader is asked about its triangles
};

/// All of one kind.
using StructureGeometries = std::vector<StructureGeometry>;

/// Usage of the buffers that StructureGeometry::data points into.
constexpr VkBufferUsageFlags kStructureInputUsage =
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

/// Bottom-level structures (BLAS) that share memory. Built together; moved into less memory where the driver says that
/// a tenth of it or more can be saved.
class BottomLevels {
public:
    BottomLevels() = default;
    /// `updatable`: update() may be called. Throws Error where they do not fit the device.
    BottomLevels(Device& device, std::span<const StructureGeometries> structures, bool updatable);

    size_t size() const { return handles_.size(); }
    VkDeviceAddress address(size_t index) const { return addresses_[index]; }
    size_t memoryBytes() const { return size() > 0 ? memory_.sizeBytes() : 0; }
    /// That the driver asked for before it was known how much is needed.
    size_t builtBytes() const { return builtBytes_; }
    /// New positions in the old topology: the same counts as it was built with.
    void update(Device& device, size_t index, const StructureGeometries& geometries);

private:
    void createStructures(const Device& device, std::span<const VkDeviceSize> sizes);
    void compact(Device& device);

    Buffer memory_;
    std::vector<StructureHandle> handles_;
    std::vector<VkDeviceAddress> addresses_;
    size_t builtBytes_ = 0;
    bool updatable_ = false;
};

/// The top-level structure (TLAS).
class TopLevel {
public:
    /// From nothing, whatever there was; none are fine. The object stays the same where as many are built again.
    void build(Device& device, std::span<const VkAccelerationStructureInstanceKHR> instances);
    VkAccelerationStructureKHR get() const { return handle_.get(); }
    size_t memoryBytes() const { return memory_.sizeBytes() + instances_.sizeBytes(); }

private:
    Buffer memory_;
    Buffer instances_;
    StructureHandle handle_;
    size_t count_ = 0;
};

}  // namespace raylab
