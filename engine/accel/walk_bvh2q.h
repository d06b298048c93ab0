#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>

#include "engine/accel/layout_bvh2q.h"

namespace raylab {

/// Slab test against quantised boxes with the operations of the GPU kernel: t = fma(q, step / d, (origin - O) / d).
struct SlabRay {
    glm::vec3 a;
    glm::vec3 b;
    float tMin;

    SlabRay(const Grid& grid, const glm::vec3& o, const glm::vec3& d, float tMin_) : tMin(tMin_) {
        for (int axis = 0; axis < 3; ++axis) {
            // Keeps 0 * infinity out: with coordinates up to kLargestCoordinate everything below stays finite.
            const float divisor = std::abs(d[axis]) < 1e-20f ? std::copysign(1e-20f, d[axis]) : d[axis];
            const float reciprocal = 1.0f / divisor;
            a[axis] = grid.step[axis] * reciprocal;
            b[axis] = (grid.origin[axis] - o[axis]) * reciprocal;
        }
    }

    /// Rounding, with u = 2^-24. A plane's t carries 3u of q * step / d and of (origin - O) / d, as |q * step| is at
    /// most the tree's extent E and |origin - O| at most |plane - O| + E: that is 3u t, and 3u E, which the spare step
    /// of the layout (E / 65528 = 256u E) covers. The reciprocal adds u here and up to 5u where Vulkan allows 2.5 ulp,
    /// an unfused fma another u: 9u a plane, 18u between the near and the far one. 33u leaves some slack (Ize, "Robust
    /// BVH Ray Traversal", JCGT 2013).
    static constexpr float kFarPadding = 1.000002f;

    /// Whether the box is hit before tMax; `tNear` says where it is entered.
    bool hits(const uint32_t (&words)[3], float tMax, float& tNear) const {
        tNear = tMin;
        float tFar = tMax;
        for (int axis = 0; axis < 3; ++axis) {
            const float t0 = std::fma(static_cast<float>(words[axis] & 0xffffu), a[axis], b[axis]);
            const float t1 = std::fma(static_cast<float>(words[axis] >> 16), a[axis], b[axis]);
            tNear = std::max(tNear, std::min(t0, t1));
            tFar = std::min(tFar, std::max(t0, t1));
        }
        return tNear <= tFar * kFarPadding;
    }
};

/// Walks the tree near child first and calls `leaf(first, count)` for the leaves that the ray (o, d; any length)
/// reaches between tMin >= 0 and tMax. `leaf` shortens the ray by lowering the same tMax; an any-hit walk ends with
/// tMax below tMin. nodes[0] is the root, `nodeBase` what flattenBvh2q() was given. Returns the largest number of
/// references that were on the stack. Does nothing for a tree without nodes.
template <class LeafFn>
uint32_t walkBvh2q(std::span<const NodeBvh2q> nodes, const Grid& grid, uint32_t nodeBase, const glm::vec3& o,
                   const glm::vec3& d, float tMin, float& tMax, LeafFn&& leaf) {
    if (nodes.empty()) return 0;
    const SlabRay ray(grid, o, d, tMin);
    uint32_t stack[kMaxBvhDepth + 2];
    uint32_t size = 0;
    uint32_t highWater = 0;
    uint32_t reference = nodeBase;
    while (true) {
        if (!isLeafReference(reference)) {
            const NodeBvh2q& node = nodes[reference - nodeBase];
            float t0 = 0.0f;
            float t1 = 0.0f;
            const bool hit0 = ray.hits(node.box0, tMax, t0);
            const bool hit1 = ray.hits(node.box1, tMax, t1);
            reference = hit0 && (!hit1 || t0 <= t1) ? node.child0 : node.child1;
            if (hit0 && hit1) {
                assert(size < std::size(stack));
                stack[size++] = reference == node.child0 ? node.child1 : node.child0;
                highWater = std::max(highWater, size);
            }
            if (hit0 || hit1) continue;
        } else {
            leaf(leafFirst(reference), leafCount(reference));
        }
        if (size == 0) return highWater;
        reference = stack[--size];
    }
}

}  // namespace raylab
