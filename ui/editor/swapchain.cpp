#include "ui/editor/swapchain.h"

#include <imgui.h>

#include <algorithm>
#include <array>

#include "engine/core/error.h"
#include "engine/gpu/check.h"
#include "engine/gpu/instance.h"
#include "engine/gpu/submit.h"
#include "ui/editor/image_barrier.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

VkSurfaceFormatKHR chooseFormat(VkPhysicalDevice device, VkSurfaceKHR surface) {
    uint32_t count = 0;
    check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, nullptr),
          "vkGetPhysicalDeviceSurfaceFormatsKHR");
    std::vector<VkSurfaceFormatKHR> formats(count);
    check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, formats.data()),
          "vkGetPhysicalDeviceSurfaceFormatsKHR");
    for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
        for (const VkSurfaceFormatKHR& format : formats)
            if (format.format == wanted) return format;
    throw Error("the display takes no pictures of 8 bits a channel", ExitCode::noDevice);
}

/// The newest picture at each refresh, without waiting for the one before, where there is such a mode.
VkPresentModeKHR chooseMode(VkPhysicalDevice device, VkSurfaceKHR surface) {
    uint32_t count = 0;
    check(vkGetPhysicalDeviceSurfacePresentModesKHR(device, surface, &count, nullptr),
          "vkGetPhysicalDeviceSurfacePresentModesKHR");
    std::vector<VkPresentModeKHR> modes(count);
    check(vkGetPhysicalDeviceSurfacePresentModesKHR(device, surface, &count, modes.data()),
          "vkGetPhysicalDeviceSurfacePresentModesKHR");
    const bool mailbox = std::ranges::find(modes, VK_PRESENT_MODE_MAILBOX_KHR) != modes.end();
    return mailbox ? VK_PRESENT_MODE_MAILBOX_KHR : VK_PRESENT_MODE_FIFO_KHR;
}

SemaphoreHandle makeSemaphore(VkDevice device) {
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    check(vkCreateSemaphore(device, &info, nullptr, &semaphore), "vkCreateSemaphore");
    return {device, semaphore};
}

}  // namespace

Swapchain::Swapchain(Device& device, VkSurfaceKHR surface)
    : device_(device),
      surface_(surface),
      format_(chooseFormat(device.physical(), surface)),
      mode_(chooseMode(device.physical(), surface)) {
    createRenderPass();
    createFrameObjects();
}

Swapchain::~Swapchain() {
    // Presentation may still read an image; a failure to wait leaves nothing to be done.
    static_cast<void>(vkQueueWaitIdle(device_.queue()));
}

void Swapchain::createRenderPass() {
    VkAttachmentDescription color{};
    color.format = format_.format;
    color.samples = VK_SAMPLE_COUNT_1_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkSubpassDependency dependency{};
    dependency.srcSubpass = VK_SUBPASS_EXTERNAL;
    dependency.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    dependency.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    dependency.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 1;
    info.pAttachments = &color;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 1;
    info.pDependencies = &dependency;
    VkRenderPass pass = VK_NULL_HANDLE;
    check(vkCreateRenderPass(device_.get(), &info, nullptr, &pass), "vkCreateRenderPass");
    renderPass_ = {device_.get(), pass};
}

void Swapchain::createFrameObjects() {
    acquired_ = makeSemaphore(device_.get());
    const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence = VK_NULL_HANDLE;
    check(vkCreateFence(device_.get(), &fenceInfo, nullptr, &fence), "vkCreateFence");
    fence_ = {device_.get(), fence};
    VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    poolInfo.queueFamilyIndex = device_.queueFamily();
    VkCommandPool pool = VK_NULL_HANDLE;
    check(vkCreateCommandPool(device_.get(), &poolInfo, nullptr, &pool), "vkCreateCommandPool");
    pool_ = {device_.get(), pool};
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = pool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device_.get(), &allocate, &commands_), "vkAllocateCommandBuffers");
}

void Swapchain::create(VkExtent2D size) {
    check(vkQueueWaitIdle(device_.queue()), "vkQueueWaitIdle");
    VkSurfaceCapabilitiesKHR capabilities{};
    check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface_, &capabilities),
          "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    const bool free = capabilities.currentExtent.width == UINT32_MAX;
    extent_ = free ? size : capabilities.currentExtent;
    extent_.width = std::clamp(extent_.width, capabilities.minImageExtent.width, capabilities.maxImageExtent.width);
    extent_.height = std::clamp(extent_.height, capabilities.minImageExtent.height, capabilities.maxImageExtent.height);
    if (extent_.width == 0 || extent_.height == 0) return;
    const uint32_t most = capabilities.maxImageCount > 0 ? capabilities.maxImageCount : UINT32_MAX;
    VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = surface_;
    info.minImageCount = std::min(std::max(capabilities.minImageCount + 1, 3u), most);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = extent_;
    info.imageArrayLayers = 1;
    info.imageUsage =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | (capabilities.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = capabilities.currentTransform;
    const bool opaque = (capabilities.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0;
    info.compositeAlpha = opaque ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = mode_;
    info.clipped = VK_TRUE;
    info.oldSwapchain = swapchain_.get();
    VkSwapchainKHR swapchain = VK_NULL_HANDLE;
    {
        const std::scoped_lock lock(loaderMutex());
        check(vkCreateSwapchainKHR(device_.get(), &info, nullptr, &swapchain), "vkCreateSwapchainKHR");
    }
    framebuffers_.clear();
    views_.clear();
    swapchain_ = {device_.get(), swapchain};
    createImages();
    stale_ = false;
}

void Swapchain::createImages() {
    uint32_t count = 0;
    check(vkGetSwapchainImagesKHR(device_.get(), swapchain_.get(), &count, nullptr), "vkGetSwapchainImagesKHR");
    images_.resize(count);
    check(vkGetSwapchainImagesKHR(device_.get(), swapchain_.get(), &count, images_.data()), "vkGetSwapchainImagesKHR");
    drawn_.clear();
    for (const VkImage image : images_) {
        VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        info.image = image;
        info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        info.format = format_.format;
        info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        VkImageView view = VK_NULL_HANDLE;
        check(vkCreateImageView(device_.get(), &info, nullptr, &view), "vkCreateImageView");
        views_.emplace_back(device_.get(), view);
        VkFramebufferCreateInfo frame{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
        frame.renderPass = renderPass_.get();
        frame.attachmentCount = 1;
        frame.pAttachments = &view;
        frame.width = extent_.width;
        frame.height = extent_.height;
        frame.layers = 1;
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        check(vkCreateFramebuffer(device_.get(), &frame, nullptr, &framebuffer), "vkCreateFramebuffer");
        framebuffers_.emplace_back(device_.get(), framebuffer);
        drawn_.push_back(makeSemaphore(device_.get()));
    }
}

bool Swapchain::present(VkExtent2D size, const Recorder& recorder, Image8* copy) {
    if (size.width == 0 || size.height == 0) return false;
    if (stale_ || size.width != extent_.width || size.height != extent_.height) create(size);
    if (stale_) return false;
    uint32_t index = 0;
    const VkResult acquired =
        vkAcquireNextImageKHR(device_.get(), swapchain_.get(), UINT64_MAX, acquired_.get(), VK_NULL_HANDLE, &index);
    if (acquired == VK_ERROR_OUT_OF_DATE_KHR) {
        stale_ = true;
        return false;
    }
    if (acquired != VK_SUBOPTIMAL_KHR) check(acquired, "vkAcquireNextImageKHR");
    Buffer readback;
    if (copy != nullptr)
        readback = Buffer(device_, "picture of the window", size_t{4} * extent_.width * extent_.height,
                          VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::readback);
    record(index, recorder, copy != nullptr ? &readback : nullptr);

    const VkSemaphore wait = acquired_.get(), signal = drawn_[index].get();
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &wait;
    info.pWaitDstStageMask = &stage;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    info.signalSemaphoreCount = 1;
    info.pSignalSemaphores = &signal;
    const VkFence fence = fence_.get();
    submit(device_, "frame", info, fence);
    const VkSwapchainKHR swapchain = swapchain_.get();
    VkPresentInfoKHR presentation{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    presentation.waitSemaphoreCount = 1;
    presentation.pWaitSemaphores = &signal;
    presentation.swapchainCount = 1;
    presentation.pSwapchains = &swapchain;
    presentation.pImageIndices = &index;
    const VkResult presented = vkQueuePresentKHR(device_.queue(), &presentation);
    stale_ = presented == VK_ERROR_OUT_OF_DATE_KHR || presented == VK_SUBOPTIMAL_KHR || acquired == VK_SUBOPTIMAL_KHR;
    if (presented != VK_ERROR_OUT_OF_DATE_KHR && presented != VK_SUBOPTIMAL_KHR) check(presented, "vkQueuePresentKHR");
    check(vkWaitForFences(device_.get(), 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    check(vkResetFences(device_.get(), 1, &fence), "vkResetFences");
    if (copy != nullptr) *copy = readCopy(readback);
    return true;
}

void Swapchain::record(uint32_t index, const Recorder& recorder, const Buffer* copyTo) {
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    recorder.before(commands_);
    VkRenderPassBeginInfo pass{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
    pass.renderPass = renderPass_.get();
    pass.framebuffer = framebuffers_[index].get();
    pass.renderArea.extent = extent_;
    VkClearValue background{};
    background.color = {{color::kPane.x, color::kPane.y, color::kPane.z, color::kPane.w}};
    pass.clearValueCount = 1;
    pass.pClearValues = &background;
    vkCmdBeginRenderPass(commands_, &pass, VK_SUBPASS_CONTENTS_INLINE);
    recorder.draw(commands_);
    vkCmdEndRenderPass(commands_);
    if (copyTo != nullptr) recordCopy(index, *copyTo);
    check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
}

void Swapchain::recordCopy(uint32_t index, const Buffer& copyTo) {
    changeLayout(commands_, images_[index], VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                 VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {extent_.width, extent_.height, 1};
    vkCmdCopyImageToBuffer(commands_, images_[index], VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, copyTo.get(), 1, &region);
    changeLayout(commands_, images_[index], VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
                 VK_ACCESS_TRANSFER_READ_BIT, 0);
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                         nullptr, 0, nullptr);
}

Image8 Swapchain::readCopy(const Buffer& buffer) const {
    Image8 image{extent_.width, extent_.height, {}, false};
    const auto* texels = reinterpret_cast<const uint32_t*>(buffer.mapped());
    image.texels.assign(texels, texels + size_t{extent_.width} * extent_.height);
    const bool blueFirst = format_.format == VK_FORMAT_B8G8R8A8_UNORM;
    for (uint32_t& texel : image.texels) {
        if (blueFirst) texel = (texel & 0x0000ff00u) | (texel >> 16 & 0xffu) | (texel & 0xffu) << 16;
        texel |= 0xff000000u;
    }
    return image;
}

}  // namespace raylab
