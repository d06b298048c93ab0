#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <string>

#include "engine/accel/build_binned.h"
#include "engine/accel/layout_bvh2q.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/accel/triangle_watertight.h"
#include "engine/accel/walk_bvh2q.h"
#include "engine/core/stopwatch.h"
#include "engine/measure/embree_peer.h"
#include "engine/measure/ray_bench.h"

namespace raylab {
namespace {

/// One ray after another on each thread: what the compute shader does, without the lanes.
class ScalarPeer : public BenchSubject {
public:
    explicit ScalarPeer(const WorldTriangles& world) {
        const Bvh bvh = buildBinned(triangleBounds(world.positions, world.triangles));
        tree_ = flattenBvh2q(bvh, 0, 0);
        for (const uint32_t id : bvh.order)
            for (int corner = 0; corner < 3; ++corner) corners_.push_back(world.positions[world.triangles[id][corner]]);
    }
    SubjectLabel label() const override { return {"scalar", "", "", "", ""}; }
    TracedRays trace(const RaySet& set) override {
        std::atomic<size_t> hits{0};
        const Stopwatch watch;
        tbb::parallel_for(tbb::blocked_range<size_t>(0, set.rays.size(), 1024), [&](const auto& range) {
            size_t found = 0;
            for (size_t i = range.begin(); i < range.end(); ++i) found += isHit(set.rays[i], set.kind.anyHit) ? 1 : 0;
            hits += found;
        });
        return {watch.seconds(), hits};
    }
    std::optional<RayCounters> count(const RaySet&) override { return std::nullopt; }

private:
    bool isHit(const shared::RayData& data, bool anyHit) const {
        const WatertightRay ray = makeWatertightRay(data.origin, data.direction);
        float tMax = data.tMax;
        bool hit = false;
        walkBvh2q(tree_.nodes, tree_.grid, 0, data.origin, data.direction, data.tMin, tMax,
                  [&](uint32_t first, uint32_t count) {
                      for (uint32_t slot = first; slot < first + count; ++slot) {
                          const glm::vec3* p = &corners_[size_t{slot} * 3];
                          float t = 0.0f, u = 0.0f, v = 0.0f;
                          if (!intersectWatertight(ray, p[0], p[1], p[2], data.tMin, tMax, t, u, v)) continue;
                          hit = true;
                          tMax = anyHit ? -1.0f : t;
                      }
                  });
        return hit;
    }

    TreeBvh2q tree_;
    std::vector<glm::vec3> corners_;
};

}  // namespace

std::vector<std::unique_ptr<BenchSubject>> makePeerSubjects(const Scene& scene) {
    const WorldTriangles world = worldTriangles(scene);
    std::vector<std::unique_ptr<BenchSubject>> peers;
    peers.push_back(std::make_unique<ScalarPeer>(world));
    for (std::unique_ptr<BenchSubject>& peer : makeEmbreePeers(world)) peers.push_back(std::move(peer));
    return peers;
}

}  // namespace raylab
