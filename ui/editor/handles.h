#pragma once

#include "engine/gpu/handle.h"

namespace raylab {

using SemaphoreHandle = Handle<VkSemaphore, vkDestroySemaphore>;
using ImageHandle = Handle<VkImage, vkDestroyImage>;
using ImageViewHandle = Handle<VkImageView, vkDestroyImageView>;
using SamplerHandle = Handle<VkSampler, vkDestroySampler>;
using FramebufferHandle = Handle<VkFramebuffer, vkDestroyFramebuffer>;
using RenderPassHandle = Handle<VkRenderPass, vkDestroyRenderPass>;
using SwapchainHandle = Handle<VkSwapchainKHR, vkDestroySwapchainKHR>;

}  // namespace raylab
