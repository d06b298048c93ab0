#include <algorithm>
#include <cmath>

#include "engine/measure/hit_oracle_surface.h"
#include "engine/scene/quadric.h"

namespace raylab::oracle {
namespace {

/// More digits than double where the machine has them: discriminants lose half of theirs.
using Real = long double;

/// Roundings of a point's coordinate: a row of a matrix for origin and direction 5 each, the distance to the closest
/// approach 4 (two sums of three products, a quotient), the way there 2.
constexpr double kPointRoundings = 16.0;
/// Of the equation: coefficients of three products each 4, discriminant 2, root, sum and quotient 2.
constexpr double kEquationRoundings = 8.0;

/// The equation along the ray, a t^2 + b t + c, and what it is made of; coordinates over the radii.
struct Equation {
    glm::vec<3, Real> origin;
    glm::vec<3, Real> direction;
    Real zz, z, constant;
    Real a, b, c;
};

Equation equationOf(const WorldRay& ray, const Placement& placement, const Quadric& quadric) {
    using Vector = glm::vec<3, Real>;
    const glm::mat<4, 4, Real> toObject(placement.toObject);
    const Vector radii(quadric.radii);
    const QuadricForm form = quadricForm(quadric.kind);
    Equation e{Vector(toObject * glm::vec<4, Real>(Vector(ray.origin), 1)) / radii,
               Vector(glm::mat<3, 3, Real>(toObject) * Vector(ray.direction)) / radii,
               form.zz,
               form.z,
               form.constant,
               0,
               0,
               0};
    const Vector &o = e.origin, &d = e.direction;
    e.a = d.x * d.x + d.y * d.y + e.zz * d.z * d.z;
    e.b = 2 * (d.x * o.x + d.y * o.y + e.zz * d.z * o.z) + e.z * d.z;
    e.c = o.x * o.x + o.y * o.y + e.zz * o.z * o.z + e.z * o.z + e.constant;
    return e;
}

double marginAt(const WorldRay& ray, const Placement& placement, const Quadric& quadric, double t) {
    const Bounds box = quadricBounds(quadric);
    const glm::dvec3 extent = glm::max(glm::abs(glm::dvec3(box.lo)), glm::abs(glm::dvec3(box.hi)));
    const glm::dvec3 world = placement.absToWorld * extent;
    const double seen = std::abs(t) * ray.length + 2.0 * std::max({world.x, world.y, world.z});
    return std::sqrt(3.0) * kRounding *
           (kPointRoundings * seen + kTransformRoundings * placement.transformMagnitude(extent, ray.origin, seen));
}

/// By how much the equation's value may be off at t: the point moved by the margin, to the second order, and its own
/// roundings.
double valueError(const Equation& e, const Placement& placement, const Quadric& quadric, double t, double margin) {
    const glm::dvec3 p(e.origin + static_cast<Real>(t) * e.direction), radii(quadric.radii);
    const double zz = static_cast<double>(e.zz), z = static_cast<double>(e.z);
    const glm::dvec3 gradientObject = glm::dvec3(2.0 * p.x, 2.0 * p.y, 2.0 * zz * p.z + z) / radii;
    const glm::dvec3 gradient = glm::transpose(glm::dmat3(placement.toObject)) * gradientObject;
    const double moved = margin * placement.inverseNorm / std::min({radii.x, radii.y, radii.z});
    const double terms = p.x * p.x + p.y * p.y + std::abs(zz) * p.z * p.z + std::abs(z * p.z) +
                         std::abs(static_cast<double>(e.constant));
    return glm::length(gradient) * margin + moved * moved + kEquationRoundings * kRounding * terms;
}

/// Whether the clip planes leave a point that is off by `error` along the axis; planes beyond the surface's own end cut
/// nothing.
Certainty clipped(const Quadric& quadric, double height, double error) {
    const double top = static_cast<double>(quadric.radii.z);
    const bool isEllipsoid = quadric.kind == QuadricKind::ellipsoid;
    const double low = static_cast<double>(quadric.clipLow), high = static_cast<double>(quadric.clipHigh);
    const bool lowCuts = isEllipsoid ? low > -top : quadric.kind != QuadricKind::paraboloid || low > 0.0;
    const bool highCuts = !isEllipsoid || high < top;
    const double inside = std::min(lowCuts ? height - low : INFINITY, highCuts ? high - height : INFINITY);
    if (inside > error) return Certainty::certain;
    return inside >= -error ? Certainty::possible : Certainty::none;
}

/// A root, and how far it may be off.
struct Root {
    double t;
    double error;
    bool exact;    ///< a root; otherwise where the ray comes closest to the surface without reaching it
    bool certain;  ///< a root whatever the rounding
};

std::optional<Candidate> candidateAt(const WorldRay& ray, const Placement& placement, uint32_t primitive,
                                     const Equation& e, const Root& root, double margin) {
    const Quadric& quadric = placement.mesh->quadrics[primitive];
    const double scale = static_cast<double>(quadric.radii.z);
    const double height = static_cast<double>(e.origin.z + static_cast<Real>(root.t) * e.direction.z) * scale;
    const double heightError =
        margin * placement.inverseNorm + root.error * std::abs(static_cast<double>(e.direction.z)) * scale;
    const Certainty left = clipped(quadric, height, heightError);
    Candidate candidate{placement.instance, primitive};
    candidate.certainty = root.certain ? left : left == Certainty::none ? left : Certainty::possible;
    candidate.exact = root.exact && clipped(quadric, height, 0.0) != Certainty::none;
    candidate.t = root.t;
    candidate.margin = margin;
    const double along = margin / ray.length;
    candidate.low = root.t - root.error - along;
    candidate.high = root.t + root.error + along;
    if (candidate.certainty == Certainty::none) return std::nullopt;
    if (!(candidate.high > ray.tMin && candidate.low <= ray.tMax)) return std::nullopt;
    limitToRange(ray, candidate);
    return candidate;
}

}  // namespace

std::array<std::optional<Candidate>, 2> intersectQuadric(const WorldRay& ray, const Placement& placement,
                                                         uint32_t primitive) {
    const Quadric& quadric = placement.mesh->quadrics[primitive];
    const Equation e = equationOf(ray, placement, quadric);
    const auto candidate = [&](const Root& root, double margin) {
        return candidateAt(ray, placement, primitive, e, root, margin);
    };
    if (e.a == 0) {
        if (e.b == 0) return {};
        const double t = static_cast<double>(-e.c / e.b);
        const double margin = marginAt(ray, placement, quadric, t);
        const double error = valueError(e, placement, quadric, t, margin) / std::abs(static_cast<double>(e.b));
        return {candidate({t, error, true, true}, margin), std::nullopt};
    }
    const Real middle = -e.b / (2 * e.a);
    const Real discriminant = e.b * e.b - 4 * e.a * e.c;
    const double steepness = std::abs(static_cast<double>(e.a));
    // Half the distance of the roots, squared; negative where there is none.
    const double square = static_cast<double>(discriminant / (4 * e.a * e.a));
    if (discriminant < 0) {
        const double t = static_cast<double>(middle), margin = marginAt(ray, placement, quadric, t);
        const double reach = valueError(e, placement, quadric, t, margin) / steepness;
        if (reach + square < 0.0) return {};
        return {candidate({t, std::sqrt(reach + square), false, false}, margin), std::nullopt};
    }
    const Real slope = std::sqrt(discriminant);
    const Real q = -(e.b + (e.b < 0 ? -slope : slope)) / 2;
    const std::array<Real, 2> roots = {q / e.a, q != 0 ? e.c / q : q / e.a};
    std::array<std::optional<Candidate>, 2> result;
    for (size_t i = 0; i < 2; ++i) {
        const double t = static_cast<double>(roots[i]), margin = marginAt(ray, placement, quadric, t);
        const double value = valueError(e, placement, quadric, t, margin);
        const double s = static_cast<double>(slope), lost = s * s - 4.0 * steepness * value;
        // The roots of the equation whose value is off by as much; where there need not be any, both roots are one.
        if (lost > 0.0) {
            result[i] = candidate({t, 2.0 * value / (s + std::sqrt(lost)), true, true}, margin);
        } else {
            const double error =
                std::sqrt(std::max(square, 0.0)) + std::sqrt(std::max(square, 0.0) + value / steepness);
            result[i] = candidate({t, error, true, false}, margin);
        }
    }
    return result;
}

}  // namespace raylab::oracle
