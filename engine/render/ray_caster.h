#pragma once

#include <span>
#include <vector>

#include "engine/render/prepared_scene.h"

namespace raylab {

/// Traces lists of rays through a prepared scene by its tracer: the same traversal text that integrators run on.
class RayCaster {
public:
    /// `batch`: rays of one dispatch at most, which bounds its time and its buffers.
    RayCaster(Device& device, const Scene& scene, const RenderSettings& settings, size_t batch = size_t{1} << 16);

    /// Closest hits; t is negative where there is none.
    std::vector<shared::HitData> closest(std::span<const shared::RayData> rays) {
        return trace(pipeline_, rays, false);
    }
    /// t is 1 where something lies between tMin and tMax, negative where not.
    std::vector<shared::HitData> occluded(std::span<const shared::RayData> rays) {
        return trace(pipeline_, rays, true);
    }
    /// Either of the two by a kernel that counts nodes, triangles and instances. `deviceSeconds` is not of the usual
    /// kernel then.
    std::vector<shared::HitData> count(std::span<const shared::RayData> rays, bool anyHit);
    /// The device's time for the last call, seconds.
    double deviceSeconds() const { return deviceSeconds_; }
    const PreparedScene& prepared() const { return prepared_; }

private:
    std::vector<shared::HitData> trace(const PipelineHandle& kernel, std::span<const shared::RayData> rays,
                                       bool anyHit);
    PipelineHandle makeKernel(bool counting) const;

    Device& device_;
    PreparedScene prepared_;
    Buffer frameBuffer_;
    KernelLayout layout_;
    PipelineHandle pipeline_;
    PipelineHandle countingPipeline_;  ///< made when it is first asked for
    size_t batch_;
    double deviceSeconds_ = 0.0;
};

}  // namespace raylab
