#include "engine/measure/hit_oracle_surface.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/scene/quadric.h"

namespace raylab::oracle {
namespace {

/// Roundings of one coordinate of a triangle's corner across the ray, in the shear of Woop, Benthin and Wald 2013
/// (others are alike): the difference to the origin 1; the shear's division 5 (Vulkan allows 2.5 units in the last
/// place), the product 1 and the difference that it multiplies 1; the last difference 2; the products of the edge
/// function 2.
constexpr double kCoordinateRoundings = 12.0;
/// Barycentrics are quotients of edge functions: two products and a difference in each, two sums of the three; thrice
/// as much for the shear, which makes lengths across the ray up to sqrt(3) times as large.
constexpr double kWeightRoundings = 15.0;
/// Neighbours are looked for within so many margins: theirs and the triangle's own may differ.
constexpr double kNeighbourMargins = 4.0;
static_assert(kNeighbourMargins * 1.7321 * kCoordinateRoundings < kWalkRoundings);

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

double cross2(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

glm::dmat3 absOf(const glm::dmat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

double frobenius(const glm::dmat3& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

/// The point of a segment that is closest to the ray.
struct Closest {
    double distance;
    double fraction;
};

Closest closestOnSegment(const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double square = glm::dot(along, along);
    const double fraction = square > 0.0 ? std::clamp(-glm::dot(a, along) / square, 0.0, 1.0) : 0.0;
    return {glm::length(a + fraction * along), fraction};
}

/// Corners as a ray sees them.
struct Seen {
    std::array<glm::dvec2, 3> p;
    std::array<double, 3> t;
    double farthest = 0.0;  ///< largest coordinate from the ray's origin
    double tLow = 0.0;
    double tHigh = 0.0;
};

Seen see(const WorldRay& ray, const std::array<glm::dvec3, 3>& corners) {
    Seen seen;
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 relative = corners[i] - ray.origin;
        seen.p[i] = {glm::dot(relative, ray.acrossX), glm::dot(relative, ray.acrossY)};
        seen.t[i] = glm::dot(relative, ray.direction) / (ray.length * ray.length);
        seen.farthest = std::max(seen.farthest, largest(glm::abs(relative)));
    }
    std::tie(seen.tLow, seen.tHigh) = std::minmax({seen.t[0], seen.t[1], seen.t[2]});
    return seen;
}

/// Change of t across the ray per length.
double slopeOf(const Seen& seen, double determinant) {
    const glm::dvec2 e1 = seen.p[1] - seen.p[0], e2 = seen.p[2] - seen.p[0];
    const double d1 = seen.t[1] - seen.t[0], d2 = seen.t[2] - seen.t[0];
    return glm::length(d1 * glm::dvec2(e2.y, -e2.x) + d2 * glm::dvec2(-e1.y, e1.x)) / std::abs(determinant);
}

/// The interval of t around candidate.t, and the errors of the barycentrics.
void boundErrors(const WorldRay& ray, const Seen& seen, double determinant, Candidate& candidate) {
    const double along = candidate.margin / ray.length;
    candidate.low = seen.tLow - along;
    candidate.high = seen.tHigh + along;
    candidate.barycentricError = glm::dvec2(1.0);
    if (determinant == 0.0) return;
    const double a = glm::length(seen.p[0]), b = glm::length(seen.p[1]), c = glm::length(seen.p[2]);
    const double weight = kWeightRoundings * kRounding * (a * b + b * c + c * a) / std::abs(determinant);
    const double error = candidate.margin * slopeOf(seen, determinant) + along + weight * (seen.tHigh - seen.tLow);
    candidate.low = std::max(candidate.low, candidate.t - error);
    candidate.high = std::min(candidate.high, candidate.t + error);
    const double perLength = candidate.margin / std::abs(determinant);
    candidate.barycentricError = {perLength * glm::length(seen.p[2] - seen.p[0]) + weight,
                                  perLength * glm::length(seen.p[1] - seen.p[0]) + weight};
}

}  // namespace

WorldRay::WorldRay(const shared::RayData& ray)
    : origin(ray.origin),
      direction(ray.direction),
      length(glm::length(direction)),
      tMin(static_cast<double>(ray.tMin)),
      tMax(static_cast<double>(ray.tMax)) {
    const glm::dvec3 unit = direction / length, size = glm::abs(unit);
    const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                             : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    acrossX = glm::normalize(glm::cross(unit, other));
    acrossY = glm::cross(unit, acrossX);
}

std::optional<Placement> Placement::make(const Scene& scene, uint32_t instance) {
    Placement p;
    p.mesh = &scene.meshes[scene.instances[instance].mesh];
    p.instance = instance;
    p.isIdentity = scene.instances[instance].objectToWorld == glm::mat4(1.0f);
    p.toWorld = glm::dmat4(scene.instances[instance].objectToWorld);
    p.toObject = glm::inverse(p.toWorld);
    const glm::dmat3 linear(p.toWorld), inverse(p.toObject);
    p.norm = frobenius(linear);
    p.inverseNorm = frobenius(inverse);
    if (!std::isfinite(p.norm) || !std::isfinite(p.inverseNorm)) return std::nullopt;
    p.absToWorld = absOf(linear);
    p.absThereAndBack = p.absToWorld * absOf(inverse);
    p.thereAndBackNorm = frobenius(p.absThereAndBack);
    p.absMovedBack = p.absToWorld * glm::abs(glm::dvec3(p.toObject[3]));
    return p;
}

double Placement::transformMagnitude(const glm::dvec3& pointObject, const glm::dvec3& originWorld,
                                     double distance) const {
    if (isIdentity) return 0.0;
    const glm::dvec3 ofPoint = absToWorld * glm::abs(pointObject) + glm::abs(glm::dvec3(toWorld[3]));
    const glm::dvec3 ofRay = absThereAndBack * (glm::abs(originWorld) + distance) + absMovedBack;
    return largest(glm::max(ofPoint, ofRay));
}

PaddedRay paddedObjectRay(const WorldRay& ray, const Placement& placement, const glm::dvec3& farthest) {
    const double scale = kWalkRoundings * kRounding * placement.inverseNorm;
    return {glm::dvec3(placement.toObject * glm::dvec4(ray.origin, 1.0)),
            glm::dmat3(placement.toObject) * ray.direction, ray.tMin,
            scale * placement.norm * (1.0 + placement.thereAndBackNorm),
            scale * placement.transformMagnitude(farthest, ray.origin, 0.0)};
}

glm::dvec3 normalAt(const Placement& placement, uint32_t primitive, const glm::dvec3& point) {
    const Mesh& mesh = *placement.mesh;
    const glm::dmat3 normalToWorld = glm::transpose(glm::dmat3(placement.toObject));
    if (!mesh.quadrics.empty()) {
        const Quadric& quadric = mesh.quadrics[primitive];
        const QuadricForm form = quadricForm(quadric.kind);
        const glm::dvec3 radii(quadric.radii);
        const glm::dvec3 p = glm::dvec3(placement.toObject * glm::dvec4(point, 1.0)) / radii;
        const double z = 2.0 * static_cast<double>(form.zz) * p.z + static_cast<double>(form.z);
        return normalToWorld * (glm::dvec3(2.0 * p.x, 2.0 * p.y, z) / radii);
    }
    const glm::uvec3 t = mesh.triangles[primitive];
    const glm::dvec3 p0(mesh.positions[t.x]);
    return normalToWorld * glm::cross(glm::dvec3(mesh.positions[t.y]) - p0, glm::dvec3(mesh.positions[t.z]) - p0);
}

void limitToRange(const WorldRay& ray, Candidate& candidate) {
    const bool within = candidate.low > ray.tMin && candidate.high <= ray.tMax;
    if (!within && candidate.certainty == Certainty::certain) candidate.certainty = Certainty::possible;
    candidate.covers = candidate.covers && within;
    candidate.exact = candidate.exact && candidate.t > ray.tMin && candidate.t <= ray.tMax;
}

std::optional<Candidate> intersectTriangle(const WorldRay& ray, const Placement& placement, uint32_t primitive) {
    const glm::uvec3 triangle = placement.mesh->triangles[primitive];
    Candidate candidate{placement.instance, primitive};
    glm::dvec3 magnitude(0.0);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 object(placement.mesh->positions[triangle[i]]);
        magnitude = glm::max(magnitude, glm::abs(object));
        candidate.corners[static_cast<size_t>(i)] = glm::dvec3(placement.toWorld * glm::dvec4(object, 1.0));
    }
    const Seen seen = see(ray, candidate.corners);
    if (!std::isfinite(seen.farthest)) return std::nullopt;
    candidate.projected = seen.p;
    candidate.margin = std::sqrt(3.0) * kRounding *
                       (kCoordinateRoundings * seen.farthest +
                        kTransformRoundings * placement.transformMagnitude(magnitude, ray.origin, seen.farthest));

    const double u = cross2(seen.p[1], seen.p[2]), v = cross2(seen.p[2], seen.p[0]), w = cross2(seen.p[0], seen.p[1]);
    const double determinant = u + v + w;
    const bool inside =
        determinant != 0.0 && ((u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0));
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < 3; ++i) {
        const size_t next = (i + 1) % 3;
        const Closest edge = closestOnSegment(seen.p[i], seen.p[next]);
        candidate.edgeDistance[i] = edge.distance;
        if (edge.distance >= nearest) continue;
        nearest = edge.distance;
        candidate.t = seen.t[i] + edge.fraction * (seen.t[next] - seen.t[i]);
        glm::dvec3 weights(0.0);
        weights[static_cast<int>(i)] = 1.0 - edge.fraction;
        weights[static_cast<int>(next)] = edge.fraction;
        candidate.barycentrics = {weights.y, weights.z};
    }
    if (!inside && nearest > kNeighbourMargins * candidate.margin) return std::nullopt;
    if (inside) candidate.t = (u * seen.t[0] + v * seen.t[1] + w * seen.t[2]) / determinant;
    if (inside) candidate.barycentrics = glm::dvec2(v, w) / determinant;
    boundErrors(ray, seen, determinant, candidate);
    if (!(candidate.high > ray.tMin && candidate.low <= ray.tMax)) return std::nullopt;
    candidate.certainty = inside && nearest > candidate.margin    ? Certainty::certain
                          : inside || nearest <= candidate.margin ? Certainty::possible
                                                                  : Certainty::none;
    candidate.exact = inside;
    candidate.covers = true;
    limitToRange(ray, candidate);
    return candidate;
}

}  // namespace raylab::oracle
