#pragma once

#include <functional>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/image/image8.h"
#include "ui/editor/handles.h"

namespace raylab {

/// The images of a window's surface, and one frame at a time on its way to them.
class Swapchain {
public:
    /// Throws Error as Vulkan does.
    Swapchain(Device& device, VkSurfaceKHR surface);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// Of every image, for pipelines: one colour attachment.
    VkRenderPass renderPass() const { return renderPass_.get(); }
    uint32_t imageCount() const { return static_cast<uint32_t>(images_.size()); }
    VkExtent2D extent() const { return extent_; }

    struct Recorder {
        std::function<void(VkCommandBuffer)> before;  ///< outside the render pass: uploads
        std::function<void(VkCommandBuffer)> draw;    ///< inside
    };
    /// Draws a frame, shows it and waits until the device has drawn it. False where the surface has no size or has just
    /// changed: nothing was drawn then. `size`: of the framebuffer. `copy`: gets the picture, where not nullptr. Throws
    /// DeviceLost; a swapchain of another device has to take this one's place then.
    bool present(VkExtent2D size, const Recorder& recorder, Image8* copy);

private:
    void create(VkExtent2D size);
    void createRenderPass();
    void createImages();
    void createFrameObjects();
    void record(uint32_t index, const Recorder& recorder, const Buffer* copyTo);
    void recordCopy(uint32_t index, const Buffer& copyTo);
    Image8 readCopy(const Buffer& buffer) const;

    Device& device_;
    VkSurfaceKHR surface_;
    VkSurfaceFormatKHR format_{};
    VkPresentModeKHR mode_ = VK_PRESENT_MODE_FIFO_KHR;
    VkExtent2D extent_{};
    bool stale_ = true;
    RenderPassHandle renderPass_;
    SwapchainHandle swapchain_;
    std::vector<VkImage> images_;
    std::vector<ImageViewHandle> views_;
    std::vector<FramebufferHandle> framebuffers_;
    std::vector<SemaphoreHandle> drawn_;  ///< by image
    SemaphoreHandle acquired_;
    FenceHandle fence_;
    CommandPoolHandle pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

}  // namespace raylab
