#pragma once

#include <vector>

#include "engine/accel/brute_force.h"
#include "engine/measure/stability/test_mesh.h"
#include "engine/render/ray_caster.h"

/// The traversal on the device against Moller and Trumbore's test in double precision over all triangles.
namespace raylab::stability {

/// All instances in world space, and where each triangle came from.
struct Flattened {
    TestMesh mesh;
    std::vector<glm::uvec2> ids;  ///< instance, primitive
};

Flattened flatten(const Scene& scene);

std::vector<OracleHit> oracleHits(const Flattened& flat, std::span<const shared::RayData> rays);

/// What is decidable in single precision: no edge within `margin`, no second surface close by.
bool isDecidable(const OracleHit& hit, double margin);

/// Rays and what they hit. `margin`: see isDecidable().
struct OracleCase {
    OracleCase(const Scene& scene, std::vector<shared::RayData> rays_, double margin_);

    /// 1e-4 of the distance, and 8 units in the last place of coordinates as large as the scene's.
    double distanceTolerance(size_t ray) const;
    bool isHit(size_t ray, const shared::HitData& got) const;

    Flattened flat;
    std::vector<shared::RayData> rays;
    std::vector<OracleHit> expected;
    double margin;
    double largestCoordinate;
};

/// Of the decidable rays.
struct Agreement {
    size_t decidable = 0;
    size_t hits = 0;
    size_t wrongHits = 0;
    size_t wrongDistances = 0;
    size_t wrongShadows = 0;
    std::vector<size_t> raysOfHits{};     ///< whose closest hits are wrong
    std::vector<size_t> raysOfShadows{};  ///< with a wrong any hit
};

/// Closest hits, and any hits of rays that end just before, just behind and far behind the closest one.
Agreement compareWithOracle(RayCaster& caster, const OracleCase& oracle);

/// Bit for bit, t and barycentrics included.
bool isSameHit(const shared::HitData& a, const shared::HitData& b);
size_t countDifferentHits(std::span<const shared::HitData> a, std::span<const shared::HitData> b);

}  // namespace raylab::stability
