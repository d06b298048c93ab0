#include "tests/support/draw_samples.h"

#include <cmath>
#include <span>

#include "engine/gpu/buffer.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/blue_noise.h"
#include "engine/render/gpu_data.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/frame.h"
#include "tests/shaders/routines.h"
#include "tests/support/paths.h"
#include "tests/support/routine_bindings.h"

namespace raylab::support {
namespace {

constexpr BindingInfo kMask{shared::kBindBlueNoise, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER};
constexpr BindingInfo kTexels{shared::kBindEnvironment, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER};
constexpr BindingInfo kAlias{shared::kBindEnvironmentAlias, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER};

LightTables tablesOf(const DrawConfig& config) {
    Scene scene;
    if (config.environment != nullptr) scene.environment = *config.environment;
    MaterialTables materials;
    return packLights(scene, 1.0f, materials);
}

shared::FrameParams frameOf(const DrawConfig& config, const LightTables& lights) {
    shared::FrameParams frame{};
    frame.seed = config.seed;
    frame.sampleCount = config.sampleCount;
    frame.strataWidth = static_cast<uint32_t>(std::sqrt(config.sampleCount));
    frame.filterRadius = config.filterRadius;
    frame.environmentWidth = lights.environmentWidth;
    frame.environmentHeight = lights.environmentHeight;
    return frame;
}

}  // namespace

std::vector<glm::vec4> drawSamples(Device& device, const DrawConfig& config) {
    const LightTables lights = tablesOf(config);
    const shared::FrameParams frame = frameOf(config, lights);
    const std::vector<uint32_t> ranks = makeBlueNoise(shared::kBlueNoiseSize);
    const auto bytes = [](const auto& data) { return std::as_bytes(std::span(data)); };
    const Buffer frameBuffer =
        makeDeviceBuffer(device, "frame", std::as_bytes(std::span(&frame, 1)), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    const TexelBuffer mask = makeTexelBuffer(device, "mask", bytes(ranks), VK_FORMAT_R32_UINT, 4);
    const TexelBuffer texels =
        makeTexelBuffer(device, "map", bytes(lights.environment), VK_FORMAT_R32G32B32A32_SFLOAT, 16);
    const TexelBuffer alias =
        makeTexelBuffer(device, "alias", bytes(lights.environmentAlias), VK_FORMAT_R32G32_UINT, 8);
    std::vector<glm::vec4> drawn(config.count);
    const Buffer result(device, "samples", bytes(drawn).size(),
                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::device);

    const BindingInfo bindings[] = {kRoutineFrame, kRoutineResult, kMask, kTexels, kAlias};
    const KernelLayout layout(device, bindings, sizeof(shared::SamplesPush));
    bindBuffer(device, layout, kRoutineFrame, frameBuffer.get(), 0, frameBuffer.sizeBytes());
    bindBuffer(device, layout, kRoutineResult, result.get(), 0, result.sizeBytes());
    bindTexelView(device, layout, kMask.binding, mask.view.get());
    bindTexelView(device, layout, kTexels.binding, texels.view.get());
    bindTexelView(device, layout, kAlias.binding, alias.view.get());
    const SpecConstant constants[] = {{shared::kSpecRoutine, config.routine},
                                      {shared::kSpecSampler, config.sampler},
                                      {shared::kSpecFilter, config.filter}};
    const Kernel kernel = makeComputeKernel(device, layout, binaryFolder() / "tests/samples.comp.spv", constants);
    const shared::SamplesPush push{config.wo,          config.alpha,       config.count, config.samplesPerPixel,
                                   config.firstSample, config.pixelsPerRow};
    const uint32_t groups = (config.count + shared::kWorkgroupSize - 1) / shared::kWorkgroupSize;
    device.run("draw samples",
               [&](VkCommandBuffer commands) { launch(device, commands, layout, kernel, {}, &push, groups); });
    download(device, result, std::as_writable_bytes(std::span(drawn)));
    return drawn;
}

}  // namespace raylab::support
