#include "engine/render/prepared_scene.h"

#include "engine/core/file.h"
#include "engine/core/stopwatch.h"
#include "engine/render/camera.h"
#include "engine/render/device_defaults.h"
#include "shaders/shared/bindings.h"

namespace raylab {

PreparedScene prepareScene(Device& device, const Scene& scene, const RenderSettings& settings) {
    PreparedScene prepared;
    prepared.camera = chooseCamera(scene, settings.camera);
    prepared.tracer = makeTracer(settings.tracer);
    const TraceConfig config =
        prepared.tracer->adapt(traceConfig(resolveForDevice(settings, device.description())));
    prepared.needs = analyseNeeds(scene, treePlanConfig(config));
    prepared.kernelNeeds = settings.needs == "full" ? shared::kNeedAll : prepared.needs.mask;
    prepared.tracer->build(device, scene, config);
    Stopwatch watch;
    prepared.gpu = std::make_unique<GpuScene>(device, scene);
    prepared.packSeconds = watch.seconds();
    return prepared;
}

std::vector<BindingInfo> sceneBindings(const PreparedScene& prepared) {
    std::vector<BindingInfo> bindings = GpuScene::bindings();
    for (const BindingInfo& info : prepared.tracer->bindings()) bindings.push_back(info);
    bindings.push_back({shared::kBindFrame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER});
    return bindings;
}

void bindScene(const Device& device, const PreparedScene& prepared, const KernelLayout& layout) {
    prepared.gpu->bind(device, layout);
    prepared.tracer->bind(device, layout);
}

shared::FrameParams makeFrame(const PreparedScene& prepared, const RenderSettings& settings) {
    shared::FrameParams frame{};
    writeCamera(prepared.camera, static_cast<uint32_t>(settings.width), static_cast<uint32_t>(settings.height), frame);
    prepared.gpu->writeFrame(frame);
    prepared.tracer->writeFrame(frame);
    frame.seed = static_cast<uint32_t>(settings.seed);
    frame.maxDepth = static_cast<uint32_t>(settings.depth);
    frame.rouletteDepth = static_cast<uint32_t>(settings.rouletteDepth);
    return frame;
}

PipelineHandle makeSceneKernel(const Device& device, const PreparedScene& prepared, const KernelLayout& layout,
                               std::string_view spirv, std::vector<SpecConstant> constants) {
    for (const SpecConstant& constant : prepared.tracer->constants()) constants.push_back(constant);
    constants.push_back({shared::kSpecNeeds, prepared.kernelNeeds});
    return makeComputePipeline(device, layout, dataFolder("shaders") / spirv, constants);
}

}  // namespace raylab
