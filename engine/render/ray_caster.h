#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/render/hit_source.h"
#include "engine/render/prepared_scene.h"

namespace raylab {

struct CountedHits {
    std::vector<shared::HitData> hits;
    std::vector<shared::RayCounts> counts;
};

/// Traces lists of rays through a prepared scene by its tracer: the same traversal text that integrators run on.
class RayCaster : public HitSource {
public:
    /// `batch`: rays of one dispatch at most, which bounds its time and its buffers.
    RayCaster(Device& device, const Scene& scene, const RenderSettings& settings, size_t batch = size_t{1} << 16);
    /// Over a scene that is prepared already, by the same settings. It ends with the next updateScene() of it.
    RayCaster(Device& device, std::shared_ptr<PreparedScene> prepared, const RenderSettings& settings,
              size_t batch = size_t{1} << 16);

    std::vector<shared::HitData> closest(std::span<const shared::RayData> rays) override {
        return trace(kernel_, rays, false);
    }
    std::vector<shared::HitData> occluded(std::span<const shared::RayData> rays) override {
        return trace(kernel_, rays, true);
    }
    /// The device's time. Of count() it is not that of the usual kernel.
    double traceSeconds() const override { return deviceSeconds_; }
    /// Either of the two by a kernel that counts.
    CountedHits count(std::span<const shared::RayData> rays, bool anyHit);
    /// Takes the scene on the device up to a change of it: updateScene(). The caster must have been made with
    /// trees = mesh.
    void update(const Scene& scene, const SceneChange& change);
    const PreparedScene& prepared() const { return *prepared_; }

private:
    /// `counts`: as many as rays, or none.
    std::vector<shared::HitData> trace(const Kernel& kernel, std::span<const shared::RayData> rays, bool anyHit,
                                       std::span<shared::RayCounts> counts = {});
    Kernel makeKernel(bool counting) const;
    void bindAll();

    Device& device_;
    RenderSettings settings_;
    std::shared_ptr<PreparedScene> prepared_;
    Buffer frameBuffer_;
    KernelLayout layout_;
    Kernel kernel_;
    Kernel countingKernel_;  ///< made when it is first asked for
    size_t batch_;
    double deviceSeconds_ = 0.0;
};

}  // namespace raylab
