#include "engine/scene/quadric.h"

#include <algorithm>
#include <cmath>

namespace raylab {

QuadricForm quadricForm(QuadricKind kind) {
    switch (kind) {
        case QuadricKind::ellipsoid:
            return {1.0f, 0.0f, -1.0f};
        case QuadricKind::cylinder:
            return {0.0f, 0.0f, -1.0f};
        case QuadricKind::cone:
            return {-1.0f, 0.0f, 0.0f};
        case QuadricKind::hyperboloid:
            return {-1.0f, 0.0f, -1.0f};
        case QuadricKind::paraboloid:
            return {0.0f, -1.0f, 0.0f};
    }
    return {};
}

Bounds quadricBounds(const Quadric& quadric) {
    const glm::dvec3 radii(quadric.radii);
    const QuadricForm form = quadricForm(quadric.kind);
    double low = quadric.clipLow, high = quadric.clipHigh;
    if (quadric.kind == QuadricKind::ellipsoid) {
        low = std::max(low, -radii.z);
        high = std::min(high, radii.z);
    }
    if (quadric.kind == QuadricKind::paraboloid) low = std::max(low, 0.0);
    if (low > high) return {glm::vec3(1.0f), glm::vec3(-1.0f)};
    // The squared radius of the section at z is a concave or convex function of z: largest at an end, or at the
    // equator.
    const auto sectionSquared = [&](double z) {
        const double scaled = z / radii.z;
        return -(form.zz * scaled * scaled + form.z * scaled + form.constant);
    };
    const double equator = std::clamp(0.0, low, high);
    const double section =
        std::sqrt(std::max({sectionSquared(low), sectionSquared(high), sectionSquared(equator), 0.0}));
    return {glm::vec3(-section * radii.x, -section * radii.y, low),
            glm::vec3(section * radii.x, section * radii.y, high)};
}

Bounds quadricBounds(const Quadric& quadric, const glm::mat4& matrix) {
    const Bounds box = quadricBounds(quadric);
    if (box.lo.x > box.hi.x) return box;
    Bounds result{glm::vec3(INFINITY), glm::vec3(-INFINITY)};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 local((corner & 1) != 0 ? box.hi.x : box.lo.x, (corner & 2) != 0 ? box.hi.y : box.lo.y,
                              (corner & 4) != 0 ? box.hi.z : box.lo.z);
        const glm::vec3 world(matrix * glm::vec4(local, 1.0f));
        result = {glm::min(result.lo, world), glm::max(result.hi, world)};
    }
    return result;
}

glm::dvec3 quadricGradient(const Quadric& quadric, const glm::dvec3& point) {
    const glm::dvec3 radii(quadric.radii);
    const QuadricForm form = quadricForm(quadric.kind);
    const glm::dvec3 p = point / radii;
    return glm::dvec3(2.0 * p.x, 2.0 * p.y, 2.0 * form.zz * p.z + form.z) / radii;
}

}  // namespace raylab
