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
    std::string_view renderKernel;  ///< SPIR-V file in the shaders folder
    std::string_view raysKernel;
};

/// A traversal backend: builds what it needs from a scene, and tells a kernel how to reach it. Integrators do not know which
/// one they run on.
class Tracer {
public:
    virtual ~Tracer() = default;
    virtual const TracerInfo& info() const = 0;
    /// `config` with what this backend cannot do replaced by what it does.
    virtual TraceConfig adapt(TraceConfig config) const = 0;
    /// Builds for `scene` by an adapted config, on the host and on the device. Throws Error where the scene is too large.
    virtual void build(Device& device, const Scene& scene, const TraceConfig& config) = 0;
    /// Descriptor bindings beyond those of the scene, and their buffers.
    virtual std::vector<BindingInfo> bindings() const = 0;
    virtual void bind(const Device& device, const KernelLayout& layout) const = 0;
    /// Specialisation constants of its kernels.
    virtual std::vector<SpecConstant> constants() const = 0;
    /// Its fields of the frame parameters.
    virtual void writeFrame(shared::FrameParams& frame) const = 0;
    /// The host's copy of the trees; nullptr where the driver keeps them.
    virtual const TraceData* traceData() const = 0;
    virtual size_t memoryBytes() const = 0;
    virtual double buildSeconds() const = 0;
    virtual double uploadSeconds() const = 0;
};

std::vector<std::string> tracerNames();

/// Throws Error where there is none of that name.
std::unique_ptr<Tracer> makeTracer(std::string_view name);

}  // namespace raylab
