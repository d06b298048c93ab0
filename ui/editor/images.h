#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "engine/gpu/buffer.h"
#include "ui/editor/handles.h"

struct ImDrawCmd;
struct ImDrawList;
struct ImVec2;

namespace raylab {

/// An 8-bit picture on the window's device, R in the lowest byte, values as the display wants them.
struct UiImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> texels;  ///< the host's copy, which outlives a device
    bool isOpaque = false;         ///< every texel
    bool written = false;          ///< the image has had texels before
    Buffer staging;
    MemoryHandle memory;
    ImageHandle image;
    ImageViewHandle view;
    DescriptorPoolHandle pool;
    VkDescriptorSet smooth = VK_NULL_HANDLE;
    VkDescriptorSet sharp = VK_NULL_HANDLE;
};
using UiImagePtr = std::shared_ptr<UiImage>;

/// Draws pictures among ImGui's own commands, by a pipeline of its own in a draw callback: ImGui's Vulkan backend knows
/// no textures but its font before version 1.87.
class ImagePainter {
public:
    ImagePainter(Device& device, VkRenderPass renderPass);
    /// Lets go of the device, of all images too, and takes another one: images come back when they are drawn.
    void releaseDevice();
    void useDevice(Device& device, VkRenderPass renderPass);
    ImagePainter(const ImagePainter&) = delete;
    ImagePainter& operator=(const ImagePainter&) = delete;

    /// Makes `image` show `texels`, width * height of them; another image takes its place where it is nullptr or of
    /// another size.
    void setTexels(UiImagePtr& image, std::span<const uint32_t> texels, uint32_t width, uint32_t height);

    /// Adds the part uv0 .. uv1 of the image to the list, filling lo .. hi (ImGui's coordinates), within the list's
    /// clip rectangle. `sharp`: texels are squares.
    void draw(ImDrawList& list, const UiImagePtr& image, const ImVec2& lo, const ImVec2& hi, const ImVec2& uv0,
              const ImVec2& uv1, bool sharp = false);

    /// Copies what setTexels() left, outside a render pass.
    void recordUploads(VkCommandBuffer commands);
    /// What the callbacks draw with; `origin` and `size` of ImGui's display, `pixels` of the framebuffer to one of its
    /// units.
    void beginDraw(VkCommandBuffer commands, const ImVec2& origin, const ImVec2& size, float pixels);
    /// After the frame is drawn.
    void endFrame() { quads_.clear(); }

private:
    struct Quad {
        ImagePainter* painter;
        UiImagePtr image;  ///< lives until the frame is drawn
        bool sharp;
        float corners[4];
        float clip[4];
        float uv[4];
    };
    static void onDraw(const ImDrawList* list, const ImDrawCmd* command);
    void drawQuad(const Quad& quad) const;
    bool showsTexelsAsPixels(const Quad& quad) const;
    void fill(const UiImagePtr& image);
    void create(UiImage& image) const;
    void release(UiImage& image) const;
    void createSets(UiImage& image) const;
    VkDescriptorSet makeSet(const UiImage& image, VkSampler sampler) const;
    PipelineHandle makePipeline(VkRenderPass renderPass, bool blends) const;
    SamplerHandle makeSampler(VkFilter filter) const;

    Device* device_ = nullptr;
    SamplerHandle smooth_, sharp_;
    DescriptorSetLayoutHandle setLayout_;
    PipelineLayoutHandle layout_;
    PipelineHandle blending_, opaque_;
    std::deque<Quad> quads_;  ///< of this frame; callbacks point to them
    std::vector<UiImagePtr> uploads_;
    std::vector<std::weak_ptr<UiImage>> images_;  ///< all that are on the device
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    float origin_[2]{}, size_[2]{}, pixels_ = 1.0f;
};

}  // namespace raylab
