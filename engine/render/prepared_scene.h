#pragma once

#include <memory>

#include "engine/render/gpu_scene.h"
#include "engine/render/render_settings.h"
#include "engine/render/tracer.h"
#include "engine/scene/needs.h"

namespace raylab {

constexpr std::string_view kFallbackTracer = "software";

/// A scene that is ready for kernels: on the device, with the tracer's structures built.
struct PreparedScene {
    SceneNeeds needs;
    uint32_t kernelNeeds = 0;  ///< mask that kernels are specialised to
    std::unique_ptr<GpuScene> gpu;
    std::unique_ptr<Tracer> tracer;
    TexelBuffer samplerMask;  ///< of the blue-noise sampler
    LightConfig lightConfig;
    Camera camera;
    Camera cameraEnd;  ///< of its motion; the same where it stands still
    glm::vec3 ambient{0.0f};  ///< radiance, of the integrators that have it
    TraceConfig traceConfig;  ///< adapted to the tracer
    double packSeconds = 0.0;  ///< packing and uploading of what is not the tracer's
};

/// The environment must be settled (settleEnvironment). Throws Error as its parts do, with ExitCode::noDevice where the device
/// lacks what the tracer needs. A tracer over the driver's structures that fails to build them is replaced by
/// kFallbackTracer, with a warning. Cancelled as buildBvh() does.
PreparedScene prepareScene(Device& device, const Scene& scene, const RenderSettings& settings,
                           const BuildControl& control = {});

/// Takes what is on the device up to a change of the scene, which must have been prepared with trees = mesh; kernels and
/// bindings are due again (bindScene, makeFrame). Throws Error as its parts do.
void updateScene(Device& device, const Scene& scene, const SceneChange& change, PreparedScene& prepared);

/// Takes materials, textures, lights and environment up to a change of them; positions and what alpha tests ask for
/// must be as they were. What is said not to have changed is neither packed nor uploaded, and of the rest those buffers
/// alone whose bytes are others. Kernels and bindings are due again. Where it throws Error, `prepared` must not be used
/// any more.
void updateShading(Device& device, const Scene& scene, PreparedScene& prepared, const SceneParts& changed = {});

/// Bindings that every kernel over a scene has; `prepared` fills them.
std::vector<BindingInfo> sceneBindings(const PreparedScene& prepared);
void bindScene(const Device& device, const PreparedScene& prepared, const KernelLayout& layout);

/// Frame parameters of the scene, the camera and the settings.
shared::FrameParams makeFrame(const PreparedScene& prepared, const RenderSettings& settings);

/// What every kernel over the prepared scene is specialised to.
std::vector<SpecConstant> sceneConstants(const PreparedScene& prepared);

/// A kernel of the tracer, specialised to the prepared scene, with constants of its own.
Kernel makeSceneKernel(Device& device, const PreparedScene& prepared, const KernelLayout& layout, KernelKind kind,
                       std::vector<SpecConstant> constants);

}  // namespace raylab
