#include "engine/render/prepared_scene.h"

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/gpu/check.h"
#include "engine/render/camera.h"
#include "engine/render/device_defaults.h"
#include "engine/render/prepared_settings.h"
#include "engine/render/sampling.h"
#include "shaders/shared/bindings.h"

namespace raylab {

namespace {

constexpr float kEndlessRay = 3.0e38f;

/// Integrators that sum over the punctual lights, and take no light from lamps or maps.
bool takesPunctualLightsAlone(const RenderSettings& settings) {
    return settings.integrator == "whitted" || settings.integrator == "direct";
}

void buildWith(std::string_view tracer, Device& device, const Scene& scene, const RenderSettings& settings,
               const BuildControl& control, PreparedScene& prepared) {
    prepared.tracer = makeTracer(tracer);
    prepared.traceConfig = prepared.tracer->adapt(traceConfig(settings, scene));
    prepared.needs = analyseNeeds(scene, treePlanConfig(prepared.traceConfig));
    prepared.kernelNeeds = settings.needs == "full" ? shared::kNeedAll : prepared.needs.mask;
    prepared.tracer->build(device, scene, prepared.traceConfig, control);
}

void buildTracer(Device& device, const Scene& scene, const RenderSettings& settings, const BuildControl& control,
                 PreparedScene& prepared) {
    const std::string missing = missingForTracer(settings.tracer, device.description());
    if (!missing.empty())
        throw Error("--tracer " + settings.tracer + ": " + device.description().name + " lacks " + missing +
                        "; use --tracer software, or another device (raylab devices)",
                    ExitCode::noDevice);
    try {
        buildWith(settings.tracer, device, scene, settings, control, prepared);
    } catch (const DeviceLost&) {
        throw;  // nothing works on that device any more
    } catch (const Error& error) {
        if (settings.tracer == kFallbackTracer) throw;
        logWarning("--tracer " + settings.tracer + " failed (" + error.what() + "); the software tracer takes over");
        buildWith(kFallbackTracer, device, scene, settings, control, prepared);
    }
}

LightChoice findLightChoice(const std::string& name) {
    if (name == "tree") return LightChoice::tree;
    if (name == "power") return LightChoice::power;
    return name == "uniform" ? LightChoice::uniform : LightChoice::automatic;
}

LightConfig lightConfig(const RenderSettings& settings) {
    LightConfig config;
    config.allPunctual = takesPunctualLightsAlone(settings);
    config.choice = config.allPunctual ? LightChoice::power : findLightChoice(settings.lightChoice);
    return config;
}

/// Light that diffuse surfaces scatter from everywhere: as asked for, or what a computed sky sends beside its sun.
glm::vec3 ambientRadiance(const Scene& scene, const RenderSettings& settings) {
    if (settings.ambient >= 0.0) return glm::vec3(static_cast<float>(settings.ambient));
    return scene.environment && scene.environment->parts ? scene.environment->parts->skyRadiance : glm::vec3(0.0f);
}

/// Needs of the scene's kernels beside what analyseNeeds() finds: a sky's sun may be a punctual light.
uint32_t needsOfLights(const Scene& scene, const LightConfig& config) {
    return hasSunLight(scene, config) ? shared::kNeedPunctual : 0u;
}

/// Under `direct` and `whitted` surfaces are lit by punctual lights and by ambient light: lamps and maps are seen, and
/// mirrored, no more.
void warnOfDarkness(const Scene& scene, const RenderSettings& settings) {
    const bool isDark = scene.lights.empty() && !hasSunLight(scene, lightConfig(settings)) &&
                        ambientRadiance(scene, settings) == glm::vec3(0.0f);
    if (takesPunctualLightsAlone(settings) && isDark)
        logWarning(scene.name + " has no point, directional or spot light: under --integrator " + settings.integrator +
                   " surfaces stay dark unless --ambient is above 0");
}

/// What prepareScene() reads of the settings beside what trees and needs are made by; the camera is not among it.
void readSettings(Device& device, const Scene& scene, const RenderSettings& settings, PreparedScene& prepared) {
    prepared.cameraEnd = settings.cameraEnd.empty() ? prepared.camera : chooseCamera(scene, settings.cameraEnd);
    prepared.lightConfig = lightConfig(settings);
    prepared.ambient = ambientRadiance(scene, settings);
    prepared.samplerMask = makeSamplerMask(device, settings);
}

}  // namespace

PreparedScene prepareScene(Device& device, const Scene& scene, const RenderSettings& settings,
                           const BuildControl& control) {
    warnOfDarkness(scene, settings);
    PreparedScene prepared;
    prepared.camera = chooseCamera(scene, settings.camera);
    buildTracer(device, scene, resolveForDevice(settings, device.description(), scene), control, prepared);
    Stopwatch watch;
    readSettings(device, scene, settings, prepared);
    prepared.kernelNeeds |= needsOfLights(scene, prepared.lightConfig);
    prepared.gpu = std::make_unique<GpuScene>(device, scene, prepared.lightConfig);
    prepared.packSeconds = watch.seconds();
    return prepared;
}

void updateScene(Device& device, const Scene& scene, const SceneChange& change, PreparedScene& prepared) {
    prepared.tracer->update(device, scene, prepared.traceConfig, change);
    updateShading(device, scene, prepared,
                  {.geometry = !change.meshes.empty(), .instances = true, .textures = false, .environment = false});
}

void updateShading(Device& device, const Scene& scene, PreparedScene& prepared, const SceneParts& changed) {
    prepared.gpu->update(device, scene, prepared.lightConfig, changed);
    prepared.needs = analyseNeeds(scene, treePlanConfig(prepared.traceConfig));
    // What is there can stay.
    prepared.kernelNeeds |= prepared.needs.mask | needsOfLights(scene, prepared.lightConfig);
}

void updateSettings(Device& device, const Scene& scene, const RenderSettings& settings, PreparedScene& prepared,
                    const SceneParts& changed) {
    warnOfDarkness(scene, settings);
    readSettings(device, scene, settings, prepared);
    updateShading(device, scene, prepared, changed);
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
    writeCameraEnd(prepared.cameraEnd, settings.shutter, frame);
    writeLens(prepared.camera, settings.lensRadius, settings.focusDistance, frame);
    writeSampling(settings, frame);
    prepared.gpu->writeFrame(frame);
    prepared.tracer->writeFrame(frame);
    frame.seed = static_cast<uint32_t>(settings.seed);
    frame.maxDepth = static_cast<uint32_t>(settings.depth);
    frame.rouletteDepth = static_cast<uint32_t>(settings.rouletteDepth);
    // Finite, so that 0 switches it off: what is left, times this, is 1 and more.
    frame.inverseThroughputEnd = 1.0f / std::max(static_cast<float>(settings.throughputEnd), 1e-30f);
    frame.mirrorAlpha = static_cast<float>(settings.mirrorRoughness * settings.mirrorRoughness);
    frame.aoDistance = settings.aoDistance > 0.0 ? static_cast<float>(settings.aoDistance) : kEndlessRay;
    frame.aoRays = static_cast<uint32_t>(settings.aoRays);
    frame.aoShare = 1.0f / static_cast<float>(settings.aoRays);
    frame.ambient = prepared.ambient;
    frame.threshold = static_cast<float>(settings.threshold);
    return frame;
}

std::vector<SpecConstant> sceneConstants(const PreparedScene& prepared) {
    return {{shared::kSpecNeeds, prepared.kernelNeeds},
            {shared::kSpecLightTree, prepared.gpu->hasLightTree() ? 1u : 0u}};
}

Kernel makeSceneKernel(Device& device, const PreparedScene& prepared, const KernelLayout& layout, KernelKind kind,
                       std::vector<SpecConstant> constants) {
    const std::vector<SpecConstant> ofScene = sceneConstants(prepared);
    constants.insert(constants.end(), ofScene.begin(), ofScene.end());
    return prepared.tracer->makeKernel(device, layout, kind, std::move(constants));
}

}  // namespace raylab
