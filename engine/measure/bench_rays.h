#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/render/ray_caster.h"
#include "engine/scene/scene.h"

namespace raylab {

/// A horizontal rectangle that shadow rays aim at.
struct BenchLight {
    glm::vec3 centre{0.0f};
    float sizeX = 0.0f;
    float sizeZ = 0.0f;
};

/// Where the rays of a benchmark start and go.
struct BenchView {
    Camera camera;
    BenchLight light;
    uint32_t width = 512;
    uint32_t height = 512;
    uint32_t seed = 0;
};

struct RayKind {
    std::string_view name;
    std::string_view help;
    bool anyHit;
    bool coherent;  ///< neighbours go the same way: what Embree's packets want to be told
};

/// What rays a benchmark traces, in the order of makeBenchRays().
inline constexpr std::array kRayKinds = {
    RayKind{"primary", "from the pinhole, in blocks of 4 x 2 pixels within tiles of 8 x 8", false, true},
    RayKind{"shadow", "any hit, from each primary hit to a random point on the light", true, true},
    RayKind{"ao", "any hit, cosine-distributed from each primary hit, a tenth of the scene's diagonal long", true,
            false},
    RayKind{"diffuse", "one cosine-distributed bounce from each primary hit, in the order of the pixels", false, false},
    RayKind{"diffuse4", "the fourth such bounce, of the paths that are still in the scene", false, false},
    RayKind{"reflection", "mirror reflection at each primary hit", false, false},
};

/// Rays of one kind, in the order of the pixels they belong to.
struct RaySet {
    RayKind kind;
    std::vector<shared::RayData> rays;
};

/// Closest-hit rays and the pixels they belong to, y * width + x.
struct PixelRays {
    std::vector<shared::RayData> rays;
    std::vector<uint32_t> pixels;
};

/// The rays of paths: [0] primary, [i] the i-th diffuse bounce of those that are still in the scene.
std::vector<PixelRays> makePathRays(HitSource& caster, const Scene& scene, const BenchView& view, int bounces);

/// The light of a view where the user names none: an eighth of the scene's extents, above its centre, just below its
/// top.
BenchLight defaultBenchLight(const Scene& scene);

/// The rays of all kinds. Hits come from `caster`, so the lists are the same for every tracer that is right.
std::vector<RaySet> makeBenchRays(HitSource& caster, const Scene& scene, const BenchView& view);

}  // namespace raylab
