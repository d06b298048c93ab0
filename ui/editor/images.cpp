#include "ui/editor/images.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/gpu/check.h"
#include "engine/gpu/shader_module.h"
#include "ui/editor/image_barrier.h"

namespace raylab {
namespace {

constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr uint32_t kPushBytes = 8 * sizeof(float);

ImageHandle makeImage(const Device& device, uint32_t width, uint32_t height) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = kFormat;
    info.extent = {width, height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    VkImage image = VK_NULL_HANDLE;
    check(vkCreateImage(device.get(), &info, nullptr, &image), "vkCreateImage");
    return {device.get(), image};
}

MemoryHandle bindMemory(const Device& device, VkImage image) {
    VkMemoryRequirements requirements{};
    vkGetImageMemoryRequirements(device.get(), image, &requirements);
    int32_t type = device.findMemoryType(requirements.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (type < 0) type = device.findMemoryType(requirements.memoryTypeBits, 0);
    VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocate.allocationSize = requirements.size;
    allocate.memoryTypeIndex = static_cast<uint32_t>(type);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device.get(), &allocate, nullptr, &memory), "memory of a picture");
    MemoryHandle owner{device.get(), memory};
    check(vkBindImageMemory(device.get(), image, memory, 0), "vkBindImageMemory");
    return owner;
}

}  // namespace

ImagePainter::ImagePainter(Device& device, VkRenderPass renderPass) { useDevice(device, renderPass); }

void ImagePainter::releaseDevice() {
    quads_.clear();
    uploads_.clear();
    for (const std::weak_ptr<UiImage>& image : images_)
        if (const UiImagePtr there = image.lock()) release(*there);
    images_.clear();
    blending_ = {};
    opaque_ = {};
    layout_ = {};
    setLayout_ = {};
    sharp_ = {};
    smooth_ = {};
    device_ = nullptr;
}

void ImagePainter::useDevice(Device& device, VkRenderPass renderPass) {
    device_ = &device;
    smooth_ = makeSampler(VK_FILTER_LINEAR);
    sharp_ = makeSampler(VK_FILTER_NEAREST);
    VkDescriptorSetLayoutBinding binding{};
    binding.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    binding.descriptorCount = 1;
    binding.stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT;
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = 1;
    setInfo.pBindings = &binding;
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device.get(), &setInfo, nullptr, &setLayout), "vkCreateDescriptorSetLayout");
    setLayout_ = {device.get(), setLayout};
    const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT, 0, kPushBytes};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &setLayout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device.get(), &info, nullptr, &layout), "vkCreatePipelineLayout");
    layout_ = {device.get(), layout};
    blending_ = makePipeline(renderPass, true);
    opaque_ = makePipeline(renderPass, false);
}

SamplerHandle ImagePainter::makeSampler(VkFilter filter) const {
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = filter;
    info.minFilter = filter;
    info.addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler = VK_NULL_HANDLE;
    check(vkCreateSampler(device_->get(), &info, nullptr, &sampler), "vkCreateSampler");
    return {device_->get(), sampler};
}

PipelineHandle ImagePainter::makePipeline(VkRenderPass renderPass, bool blends) const {
    const std::filesystem::path folder = dataFolder("shaders");
    const ShaderModuleHandle vertex = loadModule(*device_, folder / "editor_image.vert.spv", {});
    const ShaderModuleHandle fragment = loadModule(*device_, folder / "editor_image.frag.spv", {});
    const std::array stages = {stageInfo(VK_SHADER_STAGE_VERTEX_BIT, vertex.get()),
                               stageInfo(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.get())};
    const VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.lineWidth = 1.0f;
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineColorBlendAttachmentState blend{};
    blend.blendEnable = blends ? VK_TRUE : VK_FALSE;
    blend.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
    blend.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blend.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blend.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    VkPipelineColorBlendStateCreateInfo blending{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blending.attachmentCount = 1;
    blending.pAttachments = &blend;
    const std::array dynamic = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamics{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamics.dynamicStateCount = static_cast<uint32_t>(dynamic.size());
    dynamics.pDynamicStates = dynamic.data();
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pColorBlendState = &blending;
    info.pDynamicState = &dynamics;
    info.layout = layout_.get();
    info.renderPass = renderPass;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateGraphicsPipelines(device_->get(), device_->pipelineCache(), 1, &info, nullptr, &pipeline),
          "vkCreateGraphicsPipelines");
    return {device_->get(), pipeline};
}

void ImagePainter::create(UiImage& image) const {
    image.staging = Buffer(*device_, "texels of a picture", size_t{4} * image.width * image.height,
                           VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::upload);
    image.image = makeImage(*device_, image.width, image.height);
    image.memory = bindMemory(*device_, image.image.get());
    VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = image.image.get();
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = kFormat;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device_->get(), &info, nullptr, &view), "vkCreateImageView");
    image.view = {device_->get(), view};
    createSets(image);
    image.written = false;
}

void ImagePainter::release(UiImage& image) const {
    image.pool = {};
    image.view = {};
    image.image = {};
    image.memory = {};
    image.staging = {};
}

void ImagePainter::createSets(UiImage& image) const {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = 2;
    info.poolSizeCount = 1;
    info.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device_->get(), &info, nullptr, &pool), "vkCreateDescriptorPool");
    image.pool = {device_->get(), pool};
    image.smooth = makeSet(image, smooth_.get());
    image.sharp = makeSet(image, sharp_.get());
}

VkDescriptorSet ImagePainter::makeSet(const UiImage& image, VkSampler sampler) const {
    const VkDescriptorSetLayout layout = setLayout_.get();
    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorPool = image.pool.get();
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vkAllocateDescriptorSets(device_->get(), &allocate, &set), "vkAllocateDescriptorSets");
    const VkDescriptorImageInfo info{sampler, image.view.get(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &info;
    vkUpdateDescriptorSets(device_->get(), 1, &write, 0, nullptr);
    return set;
}

void ImagePainter::setTexels(UiImagePtr& image, std::span<const uint32_t> texels, uint32_t width, uint32_t height) {
    if (texels.size() != size_t{width} * height || texels.empty())
        throw Error("a picture has another number of texels than its size says", ExitCode::internalError);
    if (image == nullptr || image->width != width || image->height != height) {
        image = std::make_shared<UiImage>();
        image->width = width;
        image->height = height;
    }
    image->texels.assign(texels.begin(), texels.end());
    image->isOpaque = std::ranges::all_of(texels, [](uint32_t texel) { return texel >= 0xff000000u; });
    fill(image);
}

/// From the host's copy of its texels, with the next frame; makes the image where it is not on the device.
void ImagePainter::fill(const UiImagePtr& image) {
    if (!image->image) {
        create(*image);
        std::erase_if(images_, [](const std::weak_ptr<UiImage>& each) { return each.expired(); });
        images_.push_back(image);
    }
    std::memcpy(image->staging.mapped(), image->texels.data(), std::span(image->texels).size_bytes());
    if (std::ranges::find(uploads_, image) == uploads_.end()) uploads_.push_back(image);
}

void ImagePainter::recordUploads(VkCommandBuffer commands) {
    for (const UiImagePtr& image : uploads_) {
        const VkImageLayout old = image->written ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_UNDEFINED;
        changeLayout(commands, image->image.get(), old, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_ACCESS_SHADER_READ_BIT,
                     VK_ACCESS_TRANSFER_WRITE_BIT);
        VkBufferImageCopy region{};
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {image->width, image->height, 1};
        vkCmdCopyBufferToImage(commands, image->staging.get(), image->image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                               1, &region);
        changeLayout(commands, image->image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT);
        image->written = true;
    }
    uploads_.clear();
}

void ImagePainter::draw(ImDrawList& list, const UiImagePtr& image, const ImVec2& lo, const ImVec2& hi,
                        const ImVec2& uv0, const ImVec2& uv1, bool sharp) {
    if (!image->image) fill(image);
    const ImVec2 clipLo = list.GetClipRectMin(), clipHi = list.GetClipRectMax();
    quads_.push_back({this,
                      image,
                      sharp,
                      {lo.x, lo.y, hi.x, hi.y},
                      {clipLo.x, clipLo.y, clipHi.x, clipHi.y},
                      {uv0.x, uv0.y, uv1.x, uv1.y}});
    list.AddCallback(&ImagePainter::onDraw, &quads_.back());
    list.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
}

void ImagePainter::beginDraw(VkCommandBuffer commands, const ImVec2& origin, const ImVec2& size, float pixels) {
    commands_ = commands;
    origin_[0] = origin.x;
    origin_[1] = origin.y;
    size_[0] = size.x;
    size_[1] = size.y;
    pixels_ = pixels;
}

void ImagePainter::onDraw(const ImDrawList* /*list*/, const ImDrawCmd* command) {
    const Quad& quad = *static_cast<const Quad*>(command->UserCallbackData);
    quad.painter->drawQuad(quad);
}

bool ImagePainter::showsTexelsAsPixels(const Quad& quad) const {
    const std::array<float, 2> texels = {static_cast<float>(quad.image->width), static_cast<float>(quad.image->height)};
    for (size_t i = 0; i < 2; ++i) {
        const float pixels = pixels_ * (quad.corners[2 + i] - quad.corners[i]);
        const float start = pixels_ * (quad.corners[i] - origin_[i]);
        if (std::abs((quad.uv[2 + i] - quad.uv[i]) * texels[i] - pixels) > 1e-2f) return false;
        if (std::abs(start - std::round(start)) > 1e-3f) return false;
    }
    return true;
}

void ImagePainter::drawQuad(const Quad& quad) const {
    const auto pixel = [&](int i) {
        const int axis = i % 2;
        return std::clamp((quad.clip[i] - origin_[axis]) * pixels_, 0.0f, size_[axis] * pixels_);
    };
    const VkRect2D scissor{{static_cast<int32_t>(pixel(0)), static_cast<int32_t>(pixel(1))},
                           {static_cast<uint32_t>(std::max(pixel(2) - pixel(0), 0.0f)),
                            static_cast<uint32_t>(std::max(pixel(3) - pixel(1), 0.0f))}};
    if (scissor.extent.width == 0 || scissor.extent.height == 0) return;
    std::array<float, 8> push{};
    for (size_t i = 0; i < 4; ++i) {
        push[i] = 2.0f * (quad.corners[i] - origin_[i % 2]) / size_[i % 2] - 1.0f;
        push[4 + i] = quad.uv[i];
    }
    // Neither blended nor filtered where that changes nothing: lavapipe pays for both.
    const VkDescriptorSet set = quad.sharp || showsTexelsAsPixels(quad) ? quad.image->sharp : quad.image->smooth;
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      quad.image->isOpaque ? opaque_.get() : blending_.get());
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0, nullptr);
    vkCmdSetScissor(commands_, 0, 1, &scissor);
    vkCmdPushConstants(commands_, layout_.get(), VK_SHADER_STAGE_VERTEX_BIT, 0, kPushBytes, push.data());
    vkCmdDraw(commands_, 4, 1, 0, 0);
}

}  // namespace raylab
