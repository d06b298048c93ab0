#pragma once

#include <span>
#include <vector>

#include "engine/render/prepared_scene.h"

namespace raylab {

/// Traces lists of rays through a prepared scene by its tracer: the same traversal text that integrators run on.
class RayCaster {
public:
    RayCaster(Device& device, const Scene& scene, const RenderSettings& settings);

    /// Closest hits; t is negative where there is none.
    std::vector<shared::HitData> closest(std::span<const shared::RayData> rays) { return trace(rays, false); }
    /// t is 1 where something lies between tMin and tMax, negative where not.
    std::vector<shared::HitData> occluded(std::span<const shared::RayData> rays) { return trace(rays, true); }
    /// The device's time for the last call, seconds.
    double deviceSeconds() const { return deviceSeconds_; }
    const PreparedScene& prepared() const { return prepared_; }

private:
    std::vector<shared::HitData> trace(std::span<const shared::RayData> rays, bool anyHit);

    Device& device_;
    PreparedScene prepared_;
    Buffer frameBuffer_;
    KernelLayout layout_;
    PipelineHandle pipeline_;
    double deviceSeconds_ = 0.0;
};

}  // namespace raylab
