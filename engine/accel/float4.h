#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace raylab {

/// Four floats in one register, by the vector extension of GCC and Clang: SSE2 on any x86-64, NEON on AArch64.
/// The builders keep x, y, z in the first three lanes; the fourth is free.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));

inline Float4 splat(float value) { return Float4{value, value, value, value}; }
inline Int4 splat(int32_t value) { return Int4{value, value, value, value}; }
/// The second operand where either is NaN.
inline Float4 minimum(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 maximum(Float4 a, Float4 b) { return a > b ? a : b; }
/// NaN in the lanes where the mask (0 or -1) is set. minimum(NaN, b) and maximum(NaN, b) are b.
inline Float4 nanWhere(Int4 mask, Float4 a) { return reinterpret_cast<Float4>(reinterpret_cast<Int4>(a) | mask); }
/// Rounds towards zero.
inline Int4 truncate(Float4 a) { return __builtin_convertvector(a, Int4); }
inline Float4 toFloats(Int4 a) { return __builtin_convertvector(a, Float4); }
inline Float4 toFloat4(const glm::vec3& a) { return Float4{a.x, a.y, a.z, 0.0f}; }
inline glm::vec3 toVec3(Float4 a) { return {a[0], a[1], a[2]}; }

/// x * (y + z) + y * z of three vectors at once, after a transposition. The fourth lane repeats the third: what the
/// operands have there may be denormal, and slow.
inline Float4 halfAreas(Float4 a, Float4 b, Float4 c) {
    const Float4 xy = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Float4 z = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Float4 xs = __builtin_shufflevector(xy, c, 0, 1, 4, 4);
    const Float4 ys = __builtin_shufflevector(xy, c, 2, 3, 5, 5);
    const Float4 zs = __builtin_shufflevector(z, c, 0, 1, 6, 6);
    return xs * (ys + zs) + ys * zs;
}

/// Box in registers: the builders' inner loops; Aabb everywhere else.
struct Box4 {
    Float4 lo = splat(std::numeric_limits<float>::infinity());
    Float4 hi = splat(-std::numeric_limits<float>::infinity());

    void grow(Float4 boxLo, Float4 boxHi) {
        lo = minimum(boxLo, lo);
        hi = maximum(boxHi, hi);
    }
    void grow(const Box4& box) { grow(box.lo, box.hi); }
    /// Infinite for an empty box.
    float halfArea() const {
        const Float4 e = hi - lo;
        return e[0] * (e[1] + e[2]) + e[1] * e[2];
    }
};

}  // namespace raylab
