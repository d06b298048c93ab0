#pragma once

#include <array>
#include <optional>

#include "engine/render/prepared_scene.h"
#include "shaders/shared/wavefront.h"

namespace raylab {

/// What the buffers and the set of kernels of a wavefront depend on.
struct WavefrontPlan {
    uint32_t capacity = 0;    ///< paths at a time
    uint32_t words = 0;       ///< of 16 bytes, of a path's state
    uint32_t order = 0;       ///< kOrder...
    bool sampled = false;     ///< light is: there are shadow rays
    bool outlasting = false;  ///< paths may have more rounds than are recorded

    bool operator==(const WavefrontPlan&) const = default;
};

/// Of the settings' schedule; none where one kernel follows each path to its end. Throws Error where the integrator is
/// not `path`, and with ExitCode::noDevice where the device's subgroups have no ballot.
std::optional<WavefrontPlan> planWavefront(const Device& device, const PreparedScene& prepared,
                                           const RenderSettings& settings);

/// Bytes of a path: its state and its places in the queues, as they come.
size_t pathBytes(uint32_t needs, bool hasLightTree);

/// Tiles and samples of one submission.
struct WavefrontSlice {
    shared::RenderPush pixels;
    uint32_t tileCount = 0;
    uint32_t pathsPerLane = 0;  ///< samples of a pixel at most
    uint32_t filmOffset = 0;    ///< bytes: the band
    uint32_t maxDepth = 0;
    Bounds bounds;  ///< of the scene: what origins of rays are sorted within
};

/// Path tracing by queues: instead of one kernel that follows a path to its end, a kernel for each step of a bounce,
/// over all paths that are under way. Laine, Karras, Aila, "Megakernels Considered Harmful: Wavefront Path Tracing on
/// GPUs", HPG 2013. The same text shades, and each pixel's samples are added in their order: a film has the same bits
/// as that of the one kernel, as far as the driver compiles the text alike.
class Wavefront {
public:
    /// Buffers, bound to a layout that has bindings().
    Wavefront(Device& device, const WavefrontPlan& plan, const KernelLayout& layout);

    static std::array<BindingInfo, 2> bindings();

    /// The kernels. `constants`: what the rendering is specialised to by its settings.
    void makeKernels(Device& device, const PreparedScene& prepared, const KernelLayout& layout,
                     std::vector<SpecConstant> constants);

    /// Records all of a slice: lanes x pathsPerLane is at most the plan's capacity.
    void record(const Device& device, VkCommandBuffer commands, const KernelLayout& layout,
                const WavefrontSlice& slice) const;

    const WavefrontPlan& plan() const { return plan_; }
    size_t memoryBytes() const { return paths_.sizeBytes() + queues_.sizeBytes() + empty_.sizeBytes(); }

private:
    class Recorder;

    WavefrontPlan plan_;
    Buffer paths_;
    Buffer queues_;
    Buffer empty_;  ///< what the queues' heads begin with
    Kernel generate_, closest_, shade_, shadow_, finish_, scan_, scatter_, film_;
};

}  // namespace raylab
