#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/trace_data.h"
#include "shaders/shared/frame.h"

namespace raylab {

struct TracerInfo {
    std::string_view name;
    std::string_view help;
    bool driverStructures = false;  ///< it traces what the driver builds: layouts and triangle tests are not its own
};

/// What a kernel does with the traversal.
enum class KernelKind { render, rays, wavefront };

/// A traversal backend: builds what it needs from a scene, and makes the kernels that reach it. Integrators do not know which
/// one they run on.
class Tracer {
public:
    virtual ~Tracer() = default;
    virtual const TracerInfo& info() const = 0;
    /// `config` with what this backend cannot do replaced by what it does.
    virtual TraceConfig adapt(TraceConfig config) const = 0;
    /// Builds for `scene` by an adapted config, on the host and on the device. Throws Error where the scene is too large,
    /// and Cancelled as buildBvh() does.
    virtual void build(Device& device, const Scene& scene, const TraceConfig& config, const BuildControl& control) = 0;
    /// After build() with an adapted config: takes the structures up to what has changed of the scene. bind() is due again.
    /// Throws Error unless each mesh has a tree of its own (Trees::mesh).
    virtual void update(Device& device, const Scene& scene, const TraceConfig& config, const SceneChange& change) = 0;
    /// Descriptor bindings beyond those of the scene, and their buffers.
    virtual std::vector<BindingInfo> bindings() const = 0;
    virtual void bind(const Device& device, const KernelLayout& layout) const = 0;
    /// Stages of its kernels that see the descriptors.
    virtual VkShaderStageFlags stages() const = 0;
    /// A kernel with specialisation constants, to which those of the backend are added.
    virtual Kernel makeKernel(Device& device, const KernelLayout& layout, KernelKind kind,
                              std::vector<SpecConstant> constants) const = 0;
    /// Its fields of the frame parameters.
    virtual void writeFrame(shared::FrameParams& frame) const = 0;
    /// The host's copy of what it traces.
    virtual const TraceData& traceData() const = 0;
    virtual size_t memoryBytes() const = 0;
    virtual double buildSeconds() const = 0;
    virtual double uploadSeconds() const = 0;
};

std::vector<std::string> tracerNames();

/// What a device lacks to run a tracer: an extension or a feature. Empty where it runs. Throws Error where there is no
/// tracer of that name.
std::string missingForTracer(std::string_view name, const DeviceDescription& device);

/// Throws Error where there is none of that name.
std::unique_ptr<Tracer> makeTracer(std::string_view name);

}  // namespace raylab
