#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/measure/hit_oracle_tree.h"
#include "engine/scene/scene.h"
#include "shaders/shared/frame.h"

/// A ray and one primitive in double precision, with what a tracer in float may make of them.
namespace raylab::oracle {

/// Relative error of one rounding to float.
constexpr double kRounding = 0x1p-24;
/// Roundings of a coordinate that a 3x4 matrix of rounded entries makes: 1 an entry, 1 a product, 3 sums.
constexpr double kTransformRoundings = 5.0;

/// A ray in world space, and the plane across it that primitives are projected to.
struct WorldRay {
    explicit WorldRay(const shared::RayData& ray);

    glm::dvec3 origin;
    glm::dvec3 direction;
    double length;  ///< of the direction
    double tMin;
    double tMax;
    glm::dvec3 acrossX;  ///< unit, at right angles to each other and to the direction
    glm::dvec3 acrossY;

    glm::dvec3 at(double t) const { return origin + t * direction; }
};

/// A mesh in the world.
struct Placement {
    /// Nothing where the matrix is singular or not finite.
    static std::optional<Placement> make(const Scene& scene, uint32_t instance);

    /// How much a point of object space and the way to it may weigh in the sums of a transform: into world space, as
    /// merged trees do with vertices, or of the ray into object space and (as an error) back. Zero for the identity,
    /// which rounds nothing.
    double transformMagnitude(const glm::dvec3& pointObject, const glm::dvec3& originWorld, double distance) const;

    const Mesh* mesh;
    uint32_t instance;
    bool isIdentity;
    glm::dmat4 toWorld;
    glm::dmat4 toObject;
    glm::dmat3 absToWorld;       ///< linear part, all entries positive
    glm::dmat3 absThereAndBack;  ///< absToWorld times the positive entries of toObject
    glm::dvec3 absMovedBack;     ///< absToWorld times the positive translation of toObject
    double norm;                 ///< Frobenius, of the linear parts
    double inverseNorm;
    double thereAndBackNorm;
};

enum class Certainty { none, possible, certain };

/// What a ray makes of a primitive.
struct Candidate {
    uint32_t instance = 0;
    uint32_t primitive = 0;
    Certainty certainty = Certainty::none;  ///< none: close to the ray, but no hit
    bool exact = false;                     ///< hit in double precision, all numbers taken as they are
    double t = 0.0;
    double low = 0.0;  ///< t as floats may have it
    double high = 0.0;
    double margin = 0.0;  ///< see HitOracle; world space

    /// Of triangles, which may cover the ray together with their neighbours.
    bool covers = false;  ///< opaque, and between tMin and tMax whatever the rounding
    std::array<glm::dvec3, 3> corners{};
    std::array<glm::dvec2, 3> projected{};  ///< the corners across the ray, the ray at (0, 0)
    std::array<double, 3> edgeDistance{};   ///< of the edge from corner i to the next one
    glm::dvec2 barycentrics{0.0};           ///< of the second and third corner
    glm::dvec2 barycentricError{0.0};
};

/// Roundings that boxes are widened by: more than any margin that intersectTriangle() and intersectQuadric() use.
constexpr double kWalkRoundings = 96.0;

/// The ray in object space, with boxes there widened as much. `farthest`: the largest coordinates of the mesh.
PaddedRay paddedObjectRay(const WorldRay& ray, const Placement& placement, const glm::dvec3& farthest);

/// Geometric, of any length; `point` in world space.
glm::dvec3 normalAt(const Placement& placement, uint32_t primitive, const glm::dvec3& point);

/// Nothing where the triangle is farther from the ray than four times the margin, or all of it before tMin or behind
/// tMax. Alpha is not asked for.
std::optional<Candidate> intersectTriangle(const WorldRay& ray, const Placement& placement, uint32_t primitive);

/// Both roots, each a candidate of its own.
std::array<std::optional<Candidate>, 2> intersectQuadric(const WorldRay& ray, const Placement& placement,
                                                         uint32_t primitive);

/// Sets certainty, `exact` and `covers` of a hit by whether its interval lies between tMin and tMax.
void limitToRange(const WorldRay& ray, Candidate& candidate);

/// The distance to the origin that a surface has for certain because of several triangles that share edges near the
/// ray: the largest `high` of the nearest such group; infinite where there is none.
double coveredBy(const std::vector<Candidate>& candidates);

/// Applies the rule of alpha, as HitOracle says.
void applyAlpha(const Scene& scene, const Placement& placement, uint32_t key, Candidate& candidate);

}  // namespace raylab::oracle
