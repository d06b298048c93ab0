#pragma once

#include <memory>

#include "engine/render/gpu_scene.h"
#include "engine/render/render_settings.h"
#include "engine/render/tracer.h"
#include "engine/scene/needs.h"

namespace raylab {

/// A scene that is ready for kernels: on the device, with the tracer's structures built.
struct PreparedScene {
    SceneNeeds needs;
    uint32_t kernelNeeds = 0;  ///< mask that kernels are specialised to
    std::unique_ptr<GpuScene> gpu;
    std::unique_ptr<Tracer> tracer;
    Camera camera;
    double packSeconds = 0.0;  ///< packing and uploading of what is not the tracer's
};

/// The environment must be settled (settleEnvironment). Throws Error as its parts do.
PreparedScene prepareScene(Device& device, const Scene& scene, const RenderSettings& settings);

/// Bindings that every kernel over a scene has; `prepared` fills them.
std::vector<BindingInfo> sceneBindings(const PreparedScene& prepared);
void bindScene(const Device& device, const PreparedScene& prepared, const KernelLayout& layout);

/// Frame parameters of the scene, the camera and the settings.
shared::FrameParams makeFrame(const PreparedScene& prepared, const RenderSettings& settings);

/// A kernel from the shaders folder, specialised to the prepared scene, with constants of its own.
PipelineHandle makeSceneKernel(const Device& device, const PreparedScene& prepared, const KernelLayout& layout,
                               std::string_view spirv, std::vector<SpecConstant> constants);

}  // namespace raylab
