#include "engine/render/triangle_record.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"

/// S7: the slab test must never cull what the triangle test would hit, 0 times infinity or not.
namespace raylab::support {
namespace {

using AxisRays = GpuTest;

TEST_F(AxisRays, AreThoseOfBruteForce) {
    const Scene scene = gridOfCubes();
    const std::vector<shared::RayData> rays = raysAlongAxes(100'000, 87);
    for (const TriangleTestInfo& test : triangleTests()) {
        RenderSettings settings;
        settings.triangle = test.name;
        RayCaster brute(device_, scene, bruteForce(settings));
        const std::vector<shared::HitData> closest = brute.closest(rays), occluded = brute.occluded(rays);
        for (const LayoutInfo& layout : layouts()) {
            settings.layout = layout.name;
            RayCaster caster(device_, scene, settings);
            EXPECT_EQ(countDifferentHits(caster.closest(rays), closest), 0u) << nameOf(settings);
            EXPECT_EQ(countDifferentHits(caster.occluded(rays), occluded), 0u) << nameOf(settings);
        }
    }
}

}  // namespace
}  // namespace raylab::support
