#include "engine/gpu/buffer.h"

#include <algorithm>
#include <cstring>

#include "engine/core/error.h"
#include "engine/gpu/check.h"

namespace raylab {
namespace {

constexpr size_t kSmallestBuffer = 16;
constexpr size_t kStagingBytes = size_t{64} << 20;

std::string megabytes(uint64_t bytes) { return std::to_string((bytes + (1u << 20) - 1) >> 20) + " MiB"; }

int32_t memoryTypeFor(const Device& device, uint32_t typeBits, BufferPlace place) {
    constexpr VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    const auto first = [&](std::initializer_list<VkMemoryPropertyFlags> wishes) {
        for (const VkMemoryPropertyFlags wish : wishes)
            if (const int32_t type = device.findMemoryType(typeBits, wish); type >= 0) return type;
        return -1;
    };
    switch (place) {
        case BufferPlace::device: return first({local, 0});
        case BufferPlace::upload: return first({visible});
        case BufferPlace::readback: return first({visible | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, visible});
    }
    return -1;
}

}  // namespace

Buffer::Buffer(const Device& device, const std::string& name, size_t sizeBytes, VkBufferUsageFlags usage,
               BufferPlace place)
    : sizeBytes_(std::max(sizeBytes, kSmallestBuffer)) {
    if (sizeBytes_ > device.maxAllocationBytes())
        throw Error(name + ": " + megabytes(sizeBytes_) + " in one piece, but " + device.description().name +
                    " allocates at most " + megabytes(device.maxAllocationBytes()) + "; use a smaller scene or image");
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = sizeBytes_;
    info.usage = usage;
    VkBuffer buffer = VK_NULL_HANDLE;
    check(vkCreateBuffer(device.get(), &info, nullptr, &buffer), name.c_str());
    buffer_ = {device.get(), buffer};
    device.setName(buffer, VK_OBJECT_TYPE_BUFFER, name);

    VkMemoryRequirements requirements{};
    vkGetBufferMemoryRequirements(device.get(), buffer, &requirements);
    const int32_t type = memoryTypeFor(device, requirements.memoryTypeBits, place);
    if (type < 0) throw Error(name + ": the device has no memory of the kind that this needs", ExitCode::internalError);
    VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    if ((usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0) allocate.pNext = &flags;
    allocate.allocationSize = requirements.size;
    allocate.memoryTypeIndex = static_cast<uint32_t>(type);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device.get(), &allocate, nullptr, &memory), (name + ", " + megabytes(sizeBytes_)).c_str());
    memory_ = {device.get(), memory};
    check(vkBindBufferMemory(device.get(), buffer, memory, 0), "vkBindBufferMemory");

    constexpr VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    if (device.findMemoryType(1u << type, visible) < 0) return;
    void* pointer = nullptr;
    check(vkMapMemory(device.get(), memory, 0, VK_WHOLE_SIZE, 0, &pointer), "vkMapMemory");
    mapped_ = static_cast<std::byte*>(pointer);
}

VkDeviceAddress addressOf(const Device& device, const Buffer& buffer) {
    VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
    info.buffer = buffer.get();
    return vkGetBufferDeviceAddress(device.get(), &info);
}

void upload(Device& device, const Buffer& buffer, std::span<const std::byte> bytes, size_t offset) {
    if (offset + bytes.size() > buffer.sizeBytes()) throw Error("an upload is larger than its buffer", ExitCode::internalError);
    if (bytes.empty()) return;
    if (buffer.mapped() != nullptr) {
        std::memcpy(buffer.mapped() + offset, bytes.data(), bytes.size());
        return;
    }
    const Buffer staging(device, "staging", std::min(bytes.size(), kStagingBytes), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                         BufferPlace::upload);
    for (size_t at = 0; at < bytes.size(); at += kStagingBytes) {
        const size_t size = std::min(kStagingBytes, bytes.size() - at);
        std::memcpy(staging.mapped(), bytes.data() + at, size);
        device.run("upload", [&](VkCommandBuffer commands) {
            const VkBufferCopy region{0, offset + at, size};
            vkCmdCopyBuffer(commands, staging.get(), buffer.get(), 1, &region);
        });
    }
}

void download(Device& device, const Buffer& buffer, std::span<std::byte> bytes) {
    if (bytes.size() > buffer.sizeBytes()) throw Error("a download is larger than its buffer", ExitCode::internalError);
    if (buffer.mapped() != nullptr) {
        std::memcpy(bytes.data(), buffer.mapped(), bytes.size());
        return;
    }
    const Buffer staging(device, "readback", std::min(bytes.size(), kStagingBytes), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                         BufferPlace::readback);
    for (size_t at = 0; at < bytes.size(); at += kStagingBytes) {
        const size_t size = std::min(kStagingBytes, bytes.size() - at);
        device.run("download", [&](VkCommandBuffer commands) {
            const VkBufferCopy region{at, 0, size};
            vkCmdCopyBuffer(commands, buffer.get(), staging.get(), 1, &region);
        });
        std::memcpy(bytes.data() + at, staging.mapped(), size);
    }
}

Buffer makeDeviceBuffer(Device& device, const std::string& name, std::span<const std::byte> data, VkBufferUsageFlags usage) {
    Buffer buffer(device, name, data.size(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::device);
    upload(device, buffer, data);
    return buffer;
}

TexelBuffer makeTexelBuffer(Device& device, const std::string& name, std::span<const std::byte> data, VkFormat format,
                            size_t bytesPerElement, VkBufferUsageFlags usage) {
    if (data.size() / bytesPerElement > device.limits().maxTexelBufferElements)
        throw Error(name + ": " + std::to_string(data.size() / bytesPerElement) + " elements, but " +
                    device.description().name + " addresses at most " +
                    std::to_string(device.limits().maxTexelBufferElements) + "; use a smaller scene");
    TexelBuffer result;
    result.buffer = makeDeviceBuffer(device, name, data, usage | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    VkBufferViewCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
    info.buffer = result.buffer.get();
    info.format = format;
    info.range = VK_WHOLE_SIZE;
    VkBufferView view = VK_NULL_HANDLE;
    check(vkCreateBufferView(device.get(), &info, nullptr, &view), "vkCreateBufferView");
    result.view = {device.get(), view};
    return result;
}

}  // namespace raylab
