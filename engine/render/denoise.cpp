#include "engine/render/denoise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/luminance.h"
#include "engine/render/kernel_file.h"
#include "engine/render/render_settings.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/denoise.h"

namespace raylab {
namespace {

constexpr BindingInfo kLight{shared::kBindDenoiseLight, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER};
constexpr BindingInfo kGuides{shared::kBindDenoiseGuides, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER};
constexpr BindingInfo kResult{shared::kBindDenoiseResult, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
constexpr std::array kBindings = {kLight, kGuides, kResult};

/// A dispatch has so many pixels, which bounds its time.
constexpr uint32_t kDispatchPixels = 1u << 16;
/// With fewer samples in a pixel, its variance is taken from the pixels around.
constexpr float kFewSamples = 4.0f;
/// Surfaces that are darker are divided by this: their noise must not grow without bound.
constexpr float kLeastColour = 0.05f;
/// Rows on each side that a pixel depends on: taps of all levels, and the window that variances are estimated in.
constexpr int kApron = static_cast<int>(shared::kDenoiseReach * ((1u << shared::kDenoiseLevels) - 1u) +
                                        shared::kDenoiseWindow);

glm::vec3 colourAt(const DenoiseGuides& guides, size_t pixel) {
    const float* const rgb = guides.albedo.pixels.data() + 3 * pixel;
    return glm::max(glm::vec3(rgb[0], rgb[1], rgb[2]), kLeastColour);
}

glm::vec4 guideAt(const DenoiseGuides& guides, size_t pixel) {
    const float* const n = guides.normal.pixels.data() + 3 * pixel;
    return {2.0f * n[0] - 1.0f, 2.0f * n[1] - 1.0f, 2.0f * n[2] - 1.0f, guides.depth.pixels[3 * pixel]};
}

/// Light over colour, and the variance of the luminance of that mean, with channels that err together.
glm::vec4 lightAt(const FilmImage& film, size_t pixel, glm::vec3 colour) {
    const float count = film.samples.pixels[pixel];
    if (count <= 0.0f) return {0.0f, 0.0f, 0.0f, shared::kDenoiseEmpty};
    float light[3], deviation[3];
    for (int c = 0; c < 3; ++c) {
        light[c] = film.mean.pixels[3 * pixel + c] / colour[c];
        deviation[c] = std::sqrt(film.variance.pixels[3 * pixel + c] / count) / colour[c];
    }
    const auto ofLuminance = static_cast<float>(luminance(deviation));
    return {light[0], light[1], light[2], count < kFewSamples ? shared::kDenoiseUnknown : ofLuminance * ofLuminance};
}

TexelBuffer makeTexels(Device& device, const char* name, std::span<const glm::vec4> texels, VkBufferUsageFlags usage) {
    return makeTexelBuffer(device, name, std::as_bytes(texels), VK_FORMAT_R32G32B32A32_SFLOAT, sizeof(glm::vec4), usage);
}

}  // namespace

std::vector<std::string> denoiserNames() { return {kNoDenoiser, "atrous"}; }

Denoiser::Denoiser(Device& device, size_t mostPixels)
    : device_(device),
      mostPixels_(std::min({mostPixels, size_t{device.limits().maxStorageBufferRange} / sizeof(glm::vec4),
                            size_t{device.limits().maxTexelBufferElements}})),
      layout_(device, kBindings, sizeof(shared::DenoisePush)),
      kernel_(makeComputeKernel(device, layout_, shaderFile("denoise.comp"), {})) {}

std::optional<Bitmap> Denoiser::filter(const FilmImage& film, const DenoiseGuides& guides,
                                       const std::function<bool()>& stop) {
    deviceSeconds_ = 0.0;
    const auto width = static_cast<size_t>(film.mean.width);
    const int height = film.mean.height;
    const auto rows = static_cast<int>(std::min<size_t>(mostPixels_ / width, static_cast<size_t>(height)));
    const int inner = rows < height ? rows - 2 * kApron : height;
    if (inner <= 0) throw Error("--width " + std::to_string(width) + " is too wide for the denoiser on this device");
    const bool estimates = std::ranges::any_of(film.samples.pixels, [](float n) { return n < kFewSamples; });
    Bitmap result(film.mean.width, height, 3);
    std::vector<glm::vec4> light, surfaces;
    for (int y = 0; y < height; y += inner) {
        const int first = std::max(y - kApron, 0), end = std::min(y + inner + kApron, height);
        const size_t from = static_cast<size_t>(first) * width, to = static_cast<size_t>(end) * width;
        light.clear();
        surfaces.clear();
        for (size_t i = from; i < to; ++i) {
            light.push_back(lightAt(film, i, colourAt(guides, i)));
            surfaces.push_back(guideAt(guides, i));
        }
        if (!filterStrip(surfaces, static_cast<uint32_t>(width), estimates, light, stop)) return std::nullopt;
        const size_t resultEnd = static_cast<size_t>(std::min(y + inner, height)) * width;
        for (size_t i = static_cast<size_t>(y) * width; i < resultEnd; ++i) {
            const glm::vec3 rgb = glm::vec3(light[i - from]) * colourAt(guides, i);
            for (int c = 0; c < 3; ++c) result.pixels[3 * i + c] = rgb[c];
        }
    }
    return result;
}

/// All tasks on a strip, from one buffer to the other and back. False where it was stopped.
bool Denoiser::filterStrip(std::span<const glm::vec4> guides, uint32_t width, bool estimates,
                           std::span<glm::vec4> light, const std::function<bool()>& stop) {
    constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    const TexelBuffer surfaces = makeTexels(device_, "denoise guides", guides, 0);
    TexelBuffer from = makeTexels(device_, "denoise light", light, kUsage);
    TexelBuffer to = makeTexels(device_, "denoise result", light, kUsage);
    bindTexelView(device_, layout_, kGuides.binding, surfaces.view.get());
    const auto pixels = static_cast<uint32_t>(light.size());
    const auto apply = [&](uint32_t task, uint32_t spacing) {
        bindTexelView(device_, layout_, kLight.binding, from.view.get());
        bindBuffer(device_, layout_, kResult, to.buffer.get(), 0, to.buffer.sizeBytes());
        for (uint32_t first = 0; first < pixels; first += kDispatchPixels) {
            if (stop()) return false;
            const shared::DenoisePush push{width, pixels / width, first, std::min(kDispatchPixels, pixels - first),
                                           task, spacing};
            deviceSeconds_ += device_.run("denoise", [&](VkCommandBuffer commands) {
                launch(device_, commands, layout_, kernel_, {}, &push,
                       (push.pixelCount + shared::kWorkgroupSize - 1) / shared::kWorkgroupSize);
            });
        }
        std::swap(from, to);
        return true;
    };
    if (estimates && !apply(shared::kDenoiseEstimate, 1)) return false;
    for (uint32_t level = 0; level < shared::kDenoiseLevels; ++level)
        if (!apply(shared::kDenoiseFilter, 1u << level)) return false;
    download(device_, from.buffer, std::as_writable_bytes(light));
    return true;
}

}  // namespace raylab
