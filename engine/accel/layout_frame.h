#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "engine/accel/aabb.h"

namespace raylab {

/// The box widened on each side by 2^-22 of its largest extent and of the coordinate there, at least 1e-30: what is
/// flat keeps some thickness, more than a ray moves where |d| is replaced by 1e-20; a ray that lies in a face is inside,
/// whatever the sign of its zeros; and a kernel may flush denormals. Rounding takes half of the coordinate's part.
inline Aabb paddedBox(const Aabb& box) {
    const glm::vec3 extent = box.extent();
    const float thickness = std::max(std::max({extent.x, extent.y, extent.z}) * 0x1p-22f, 1e-30f);
    return {box.lo - (glm::abs(box.lo) * 0x1p-22f + thickness), box.hi + (glm::abs(box.hi) * 0x1p-22f + thickness)};
}

/// Local frame of a compressed wide node (Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal on GPUs Through
/// Compressed Wide BVHs", HPG 2017, section 3.1): coordinate = origin + q * 2^exponent, q of 8 bits.
struct LocalFrame {
    glm::vec3 origin;
    glm::vec3 inverseStep;
    uint32_t exponents;  ///< biased by 127, eight bits each from x on: the bits of a float that is the step
};

/// Smallest frame in which the padded `box` ends at 254.5 or before. The origin is the box's corner, exactly. Steps are
/// 2^-100 at least, so that a kernel's products with 1 / d stay normal floats.
inline LocalFrame localFrame(const Aabb& box) {
    const Aabb padded = paddedBox(box);
    const glm::vec3 extent = padded.extent();
    LocalFrame frame{padded.lo, glm::vec3(0.0f), 0};
    for (int axis = 0; axis < 3; ++axis) {
        int exponent = 0;
        std::frexp(extent[axis] / 254.5f, &exponent);
        exponent = std::max(exponent, -100);
        frame.inverseStep[axis] = std::ldexp(1.0f, -exponent);
        frame.exponents |= static_cast<uint32_t>(exponent + 127) << (8 * axis);
    }
    return frame;
}

/// The steps that exponents stand for.
inline glm::vec3 frameStep(uint32_t exponents) {
    const glm::uvec3 biased = (glm::uvec3(exponents) >> glm::uvec3(0, 8, 16)) & 255u;
    return glm::uintBitsToFloat(biased << 23u);
}

/// What a plane is moved outwards by, in steps. A kernel computes fma(q, step / d, (origin - O) / d); with u = 2^-24
/// the difference and its product err by 2u |origin - O|, which is at most 2u |plane - O| + 2u * 255 steps, and the
/// product with q by u * 255 steps where it is not fused: 4.6e-5 steps. The float arithmetic here adds 2.3e-5. The
/// plane at q = 0 needs no margin: it is the origin itself. What errs in proportion to |plane - O| is in kSlabPad.
constexpr float kFrameMargin = 0x1p-13f;

struct QuantisedBox {
    glm::uvec3 lo;  ///< 0 .. 255 on each axis
    glm::uvec3 hi;
};

/// Rounds a box within the frame's box outwards.
inline QuantisedBox quantise(const LocalFrame& frame, const Aabb& box) {
    const Aabb padded = paddedBox(box);
    const glm::vec3 lo = glm::max((padded.lo - frame.origin) * frame.inverseStep - kFrameMargin, 0.0f);
    const glm::vec3 hi = (padded.hi - frame.origin) * frame.inverseStep + kFrameMargin;
    return {glm::uvec3(lo), glm::uvec3(hi) + 1u};
}

}  // namespace raylab
