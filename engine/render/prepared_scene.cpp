#include "engine/render/prepared_scene.h"

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/render/camera.h"
#include "engine/render/device_defaults.h"
#include "engine/render/sampling.h"
#include "shaders/shared/bindings.h"

namespace raylab {

namespace {

constexpr float kEndlessRay = 3.0e38f;

void buildWith(std::string_view tracer, Device& device, const Scene& scene, const RenderSettings& settings,
               PreparedScene& prepared) {
    prepared.tracer = makeTracer(tracer);
    prepared.traceConfig = prepared.tracer->adapt(traceConfig(settings));
    prepared.needs = analyseNeeds(scene, treePlanConfig(prepared.traceConfig));
    prepared.kernelNeeds = settings.needs == "full" ? shared::kNeedAll : prepared.needs.mask;
    prepared.tracer->build(device, scene, prepared.traceConfig);
}

void buildTracer(Device& device, const Scene& scene, const RenderSettings& settings, PreparedScene& prepared) {
    const std::string missing = missingForTracer(settings.tracer, device.description());
    if (!missing.empty())
        throw Error("--tracer " + settings.tracer + ": " + device.description().name + " lacks " + missing +
                        "; use --tracer software, or another device (raylab devices)",
                    ExitCode::noDevice);
    try {
        buildWith(settings.tracer, device, scene, settings, prepared);
    } catch (const Error& error) {
        if (settings.tracer == kFallbackTracer) throw;
        logWarning("--tracer " + settings.tracer + " failed (" + error.what() + "); the software tracer takes over");
        buildWith(kFallbackTracer, device, scene, settings, prepared);
    }
}

/// Whitted's surfaces are lit by punctual lights and by ambient light: lamps and skies are seen, and mirrored, no more.
void warnOfDarkness(const Scene& scene, const RenderSettings& settings) {
    if (settings.integrator == "whitted" && scene.lights.empty() && settings.ambient == 0.0)
        logWarning(scene.name + " has no point, directional or spot light: surfaces stay dark unless --ambient is above 0");
}

}  // namespace

PreparedScene prepareScene(Device& device, const Scene& scene, const RenderSettings& settings) {
    warnOfDarkness(scene, settings);
    PreparedScene prepared;
    prepared.camera = chooseCamera(scene, settings.camera);
    buildTracer(device, scene, resolveForDevice(settings, device.description()), prepared);
    Stopwatch watch;
    prepared.lightChoice = settings.lightChoice == "uniform" ? LightChoice::uniform : LightChoice::power;
    prepared.gpu = std::make_unique<GpuScene>(device, scene, prepared.lightChoice);
    prepared.samplerMask = makeSamplerMask(device, settings);
    prepared.packSeconds = watch.seconds();
    return prepared;
}

void updateScene(Device& device, const Scene& scene, const SceneChange& change, PreparedScene& prepared) {
    prepared.tracer->update(device, scene, prepared.traceConfig, change);
    prepared.gpu = std::make_unique<GpuScene>(device, scene, prepared.lightChoice);
    prepared.needs = analyseNeeds(scene, treePlanConfig(prepared.traceConfig));
    prepared.kernelNeeds |= prepared.needs.mask;  // what is there can stay
}

std::vector<BindingInfo> sceneBindings(const PreparedScene& prepared) {
    std::vector<BindingInfo> bindings = GpuScene::bindings();
    for (const BindingInfo& info : prepared.tracer->bindings()) bindings.push_back(info);
    bindings.push_back({shared::kBindBlueNoise, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER});
    bindings.push_back({shared::kBindFrame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER});
    return bindings;
}

void bindScene(const Device& device, const PreparedScene& prepared, const KernelLayout& layout) {
    prepared.gpu->bind(device, layout);
    prepared.tracer->bind(device, layout);
    bindTexelView(device, layout, shared::kBindBlueNoise, prepared.samplerMask.view.get());
}

shared::FrameParams makeFrame(const PreparedScene& prepared, const RenderSettings& settings) {
    shared::FrameParams frame{};
    writeCamera(prepared.camera, static_cast<uint32_t>(settings.width), static_cast<uint32_t>(settings.height), frame);
    writeLens(prepared.camera, settings.lensRadius, settings.focusDistance, frame);
    writeSampling(settings, frame);
    prepared.gpu->writeFrame(frame);
    prepared.tracer->writeFrame(frame);
    frame.seed = static_cast<uint32_t>(settings.seed);
    frame.maxDepth = static_cast<uint32_t>(settings.depth);
    frame.rouletteDepth = static_cast<uint32_t>(settings.rouletteDepth);
    frame.mirrorAlpha = static_cast<float>(settings.mirrorRoughness * settings.mirrorRoughness);
    frame.aoDistance = settings.aoDistance > 0.0 ? static_cast<float>(settings.aoDistance) : kEndlessRay;
    frame.aoRays = static_cast<uint32_t>(settings.aoRays);
    frame.aoShare = 1.0f / static_cast<float>(settings.aoRays);
    frame.ambient = static_cast<float>(settings.ambient);
    frame.threshold = static_cast<float>(settings.threshold);
    return frame;
}

Kernel makeSceneKernel(Device& device, const PreparedScene& prepared, const KernelLayout& layout, KernelKind kind,
                       std::vector<SpecConstant> constants) {
    constants.push_back({shared::kSpecNeeds, prepared.kernelNeeds});
    return prepared.tracer->makeKernel(device, layout, kind, std::move(constants));
}

}  // namespace raylab
