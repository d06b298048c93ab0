#include "engine/measure/stability/oracle_case.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/bounds.h"

namespace raylab::stability {
namespace {

double largestCoordinateOf(const Scene& scene) {
    const Bounds bounds = sceneBounds(scene);
    const glm::vec3 largest = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
    return static_cast<double>(std::max({largest.x, largest.y, largest.z}));
}

struct Answers {
    std::vector<shared::HitData> closest, occluded;
    std::vector<shared::HitData> occludedBefore, occludedBehind;  ///< of rays that end just before and behind the hit
};

Answers askDevice(RayCaster& caster, const OracleCase& oracle) {
    std::vector<shared::RayData> before = oracle.rays, behind = oracle.rays;
    for (size_t i = 0; i < oracle.rays.size(); ++i) {
        if (!oracle.expected[i].hit()) continue;
        const double margin = 4.0 * oracle.distanceTolerance(i);
        before[i].tMax = static_cast<float>(oracle.expected[i].t - margin);
        behind[i].tMax = static_cast<float>(oracle.expected[i].t + margin);
    }
    return {caster.closest(oracle.rays), caster.occluded(oracle.rays), caster.occluded(before),
            caster.occluded(behind)};
}

}  // namespace

Flattened flatten(const Scene& scene) {
    Flattened flat;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto base = static_cast<uint32_t>(flat.mesh.positions.size());
        for (const glm::vec3& p : mesh.positions)
            flat.mesh.positions.emplace_back(glm::dmat4(instance.objectToWorld) * glm::dvec4(p, 1.0));
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            flat.mesh.triangles.push_back(mesh.triangles[t] + base);
            flat.ids.emplace_back(i, t);
        }
    }
    return flat;
}

std::vector<OracleHit> oracleHits(const Flattened& flat, std::span<const shared::RayData> rays) {
    std::vector<OracleRay> oracleRays;
    for (const shared::RayData& ray : rays) oracleRays.push_back({ray.origin, ray.direction, ray.tMin});
    return closestHitsDouble(flat.mesh.positions, flat.mesh.triangles, oracleRays);
}

bool isDecidable(const OracleHit& hit, double margin) {
    return hit.margin >= margin && !(hit.hit() && hit.tNext < hit.t * 1.0001);
}

OracleCase::OracleCase(const Scene& scene, std::vector<shared::RayData> rays_, double margin_)
    : flat(flatten(scene)),
      rays(std::move(rays_)),
      expected(oracleHits(flat, rays)),
      margin(margin_),
      largestCoordinate(largestCoordinateOf(scene)) {}

double OracleCase::distanceTolerance(size_t ray) const {
    const double length = static_cast<double>(glm::length(rays[ray].direction));
    return 1e-4 * expected[ray].t + 8.0 * 0x1p-24 * largestCoordinate / length;
}

bool OracleCase::isHit(size_t ray, const shared::HitData& got) const {
    const OracleHit& oracle = expected[ray];
    if (!oracle.hit() || got.t < 0.0f) return oracle.hit() == (got.t >= 0.0f);
    return flat.ids[oracle.primitive] == glm::uvec2(got.instance, got.primitive);
}

Agreement compareWithOracle(RayCaster& caster, const OracleCase& oracle) {
    const Answers answers = askDevice(caster, oracle);
    Agreement a;
    for (size_t i = 0; i < oracle.rays.size(); ++i) {
        const OracleHit& expected = oracle.expected[i];
        if (!isDecidable(expected, oracle.margin)) continue;
        ++a.decidable;
        a.hits += expected.hit() ? 1u : 0u;
        const bool same = oracle.isHit(i, answers.closest[i]);
        const double error = std::abs(static_cast<double>(answers.closest[i].t) - expected.t);
        a.wrongHits += same ? 0u : 1u;
        a.wrongDistances += same && expected.hit() && error > oracle.distanceTolerance(i) ? 1u : 0u;
        const size_t shadowsBefore = a.wrongShadows;
        a.wrongShadows += (answers.occluded[i].t >= 0.0f) != expected.hit() ? 1u : 0u;
        a.wrongShadows += expected.hit() && answers.occludedBefore[i].t >= 0.0f ? 1u : 0u;
        a.wrongShadows += expected.hit() && answers.occludedBehind[i].t < 0.0f ? 1u : 0u;
        if (!same) a.raysOfHits.push_back(i);
        if (a.wrongShadows > shadowsBefore) a.raysOfShadows.push_back(i);
    }
    return a;
}

bool isSameHit(const shared::HitData& a, const shared::HitData& b) {
    return a.t == b.t && a.u == b.u && a.v == b.v && a.instance == b.instance && a.primitive == b.primitive;
}

size_t countDifferentHits(std::span<const shared::HitData> a, std::span<const shared::HitData> b) {
    size_t different = std::max(a.size(), b.size()) - std::min(a.size(), b.size());
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) different += isSameHit(a[i], b[i]) ? 0u : 1u;
    return different;
}

}  // namespace raylab::stability
