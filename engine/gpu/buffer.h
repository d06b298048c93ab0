#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <span>
#include <string>

#include "engine/gpu/device.h"
#include "engine/gpu/handle.h"

namespace raylab {

enum class BufferPlace {
    device,    ///< fast for the device; written by upload()
    upload,    ///< mapped, written by the host
    readback,  ///< mapped, read by the host
};

/// A VkBuffer with memory of its own. Sizes are in bytes; a size of 0 makes a buffer of 16 bytes, so that every binding
/// has something to show.
class Buffer {
public:
    Buffer() = default;
    /// Throws Error where the size is beyond what the device can allocate, or the memory is full.
    Buffer(const Device& device, const std::string& name, size_t sizeBytes, VkBufferUsageFlags usage, BufferPlace place);

    VkBuffer get() const { return buffer_.get(); }
    size_t sizeBytes() const { return sizeBytes_; }
    /// The host's view of the memory; nullptr where the device's memory is not visible to the host.
    std::byte* mapped() const { return mapped_; }

private:
    BufferHandle buffer_;
    MemoryHandle memory_;
    size_t sizeBytes_ = 0;
    std::byte* mapped_ = nullptr;
};

/// Of a buffer with VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT, on a device that traces rays.
VkDeviceAddress addressOf(const Device& device, const Buffer& buffer);

/// Writes `bytes` to the buffer from `offset` on, through a staging buffer where the host does not see it.
void upload(Device& device, const Buffer& buffer, std::span<const std::byte> bytes, size_t offset = 0);

/// Copies the first `bytes.size()` bytes of the buffer to the host.
void download(Device& device, const Buffer& buffer, std::span<std::byte> bytes);

/// A device buffer that holds `data`, with what upload needs added to `usage`.
Buffer makeDeviceBuffer(Device& device, const std::string& name, std::span<const std::byte> data, VkBufferUsageFlags usage);

/// A device buffer and its view as uniform texels, which reach beyond the device's range of storage buffers.
struct TexelBuffer {
    Buffer buffer;
    BufferViewHandle view;
};

/// Throws Error where `data` has more elements than the device can address. `usage`: beyond that of texels.
TexelBuffer makeTexelBuffer(Device& device, const std::string& name, std::span<const std::byte> data, VkFormat format,
                            size_t bytesPerElement, VkBufferUsageFlags usage = 0);

}  // namespace raylab
