#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/ray_caster.h"
#include "engine/scene/scene.h"

namespace raylab {

constexpr uint32_t kNothingHit = ~uint32_t{0};

/// What lies behind the middle of each pixel of a view.
struct HitMap {
    struct Hit {
        uint32_t instance = kNothingHit;  ///< of the scene that is rendered
        uint32_t primitive = 0;

        bool operator==(const Hit&) const = default;
    };

    uint32_t width = 0;
    uint32_t height = 0;
    Camera camera;
    std::vector<Hit> hits;  ///< row by row from the top

    const Hit& at(uint32_t x, uint32_t y) const { return hits[size_t{y} * width + x]; }
};

/// Through a point of the view, (0, 0) at its upper left and (1, 1) at its lower right; without lens or motion.
shared::RayData viewRay(const Camera& camera, double aspect, double x, double y);

HitMap traceHitMap(RayCaster& caster, const Camera& camera, uint32_t width, uint32_t height);

}  // namespace raylab
