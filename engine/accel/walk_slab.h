#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace raylab {

/// Slab tests with the operations of the GPU kernels. The distance to the far plane is padded by this factor (Ize,
/// "Robust BVH Ray Traversal", JCGT 2013), rounding being, with u = 2^-24, of one plane's t:
/// - 5u by the reciprocal where Vulkan allows 2.5 ulp (u here), which both terms of a plane share, and u by its product;
/// - u by the difference plane - O, or origin - O;
/// - u by the sum of the two terms and u by their product with q, where a plane is origin + q * step.
/// In proportion to t that is 9u at most, 18u between the near and the far plane; 33u leave some slack for what the
/// triangle test rounds. The part that grows with q * step instead is covered by the layouts: 3u of a tree's extent E
/// by bvh2q's spare step (E / 65528 = 256u E), 3u of 255 steps by the kFrameMargin of local frames.
constexpr float kSlabPad = 1.000002f;

/// 1 / d. Components below 1e-20 count as that, which keeps 0 * infinity out: with coordinates up to kLargestCoordinate
/// everything below stays finite.
inline glm::vec3 slabReciprocal(const glm::vec3& d) {
    glm::vec3 reciprocal;
    for (int axis = 0; axis < 3; ++axis)
        reciprocal[axis] = 1.0f / (std::abs(d[axis]) < 1e-20f ? (d[axis] < 0.0f ? -1e-20f : 1e-20f) : d[axis]);
    return reciprocal;
}

/// A ray against boxes whose coordinates are origin + q * step: t = q * step / d + (origin - O) / d.
struct GridSlab {
    glm::vec3 scale;
    glm::vec3 offset;

    GridSlab(const glm::vec3& origin, const glm::vec3& step, const glm::vec3& o, const glm::vec3& reciprocal)
        : scale(step * reciprocal), offset((origin - o) * reciprocal) {}

    glm::vec3 at(const glm::uvec3& q) const { return glm::vec3(q) * scale + offset; }
};

/// Whether a ray meets a box before tMax; `tNear` says where it enters. t0 and t1: distances to its planes, in any order.
inline bool slabHit(const glm::vec3& t0, const glm::vec3& t1, float tMin, float tMax, float& tNear) {
    const glm::vec3 enter = glm::min(t0, t1);
    const glm::vec3 leave = glm::max(t0, t1);
    tNear = std::max(std::max(enter.x, enter.y), std::max(enter.z, tMin));
    return tNear <= std::min(std::min(leave.x, leave.y), std::min(leave.z, tMax)) * kSlabPad;
}

}  // namespace raylab
