#include "engine/measure/hit_oracle.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/measure/hit_oracle_surface.h"
#include "engine/measure/hit_oracle_tree.h"
#include "engine/scene/quadric.h"

namespace raylab {
namespace {

using oracle::Box;
using oracle::Candidate;
using oracle::Certainty;
using oracle::PaddedTree;
using oracle::Placement;
using oracle::WorldRay;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Box> primitiveBoxes(const Mesh& mesh) {
    std::vector<Box> boxes;
    for (const glm::uvec3& t : mesh.triangles) {
        Box box;
        for (int corner = 0; corner < 3; ++corner) box.include(glm::dvec3(mesh.positions[t[corner]]));
        const bool finite = std::isfinite(glm::length(box.hi - box.lo));
        boxes.push_back(finite ? box : Box{});
    }
    for (const Quadric& quadric : mesh.quadrics) {
        const Bounds bounds = quadricBounds(quadric);
        boxes.push_back({glm::dvec3(bounds.lo), glm::dvec3(bounds.hi)});
    }
    return boxes;
}

Box worldBox(const Box& box, const glm::dmat4& toWorld) {
    Box result;
    for (int corner = 0; corner < 8 && !box.isEmpty(); ++corner)
        result.include(glm::dvec3(toWorld * glm::dvec4((corner & 1) != 0 ? box.hi.x : box.lo.x,
                                                       (corner & 2) != 0 ? box.hi.y : box.lo.y,
                                                       (corner & 4) != 0 ? box.hi.z : box.lo.z, 1.0)));
    return result;
}

std::vector<PaddedTree> meshTrees(const Scene& scene) {
    std::vector<PaddedTree> trees(scene.meshes.size(), PaddedTree({}));
    tbb::parallel_for(size_t{0}, trees.size(),
                      [&](size_t i) { trees[i] = PaddedTree(primitiveBoxes(scene.meshes[i])); });
    return trees;
}

std::vector<Placement> placementsOf(const Scene& scene) {
    std::vector<Placement> placements;
    for (uint32_t i = 0; i < scene.instances.size(); ++i)
        if (const std::optional<Placement> placement = Placement::make(scene, i)) placements.push_back(*placement);
    return placements;
}

/// All that a ray may hit, up to the first surface that it hits for certain.
struct Gathered {
    std::vector<Candidate> candidates;
    double barrier = kInfinity;  ///< t that is not passed
};

/// Whether a tracer may answer with this hit; nothing where it may not.
const Candidate* rightHit(const Gathered& gathered, const shared::HitData& claim) {
    const auto t = static_cast<double>(claim.t);
    for (const Candidate& c : gathered.candidates)
        if (c.certainty != Certainty::none && c.instance == claim.instance && c.primitive == claim.primitive &&
            t >= c.low && t <= c.high && c.low <= gathered.barrier)
            return &c;
    return nullptr;
}

bool mayMiss(const Gathered& gathered) { return gathered.barrier == kInfinity; }

bool mayHit(const Gathered& gathered) {
    return std::ranges::any_of(gathered.candidates, [](const Candidate& c) { return c.certainty != Certainty::none; });
}

Verdict verdictOf(bool aRight, bool bRight, bool same) {
    if (aRight && bRight) return same ? Verdict::tie : Verdict::undecidable;
    if (!aRight && !bRight) return Verdict::neither;
    return aRight ? Verdict::aRight : Verdict::bRight;
}

TrueHit truthOf(const Gathered& gathered) {
    TrueHit truth;
    for (const Candidate& c : gathered.candidates)
        if (c.exact && c.t < truth.t) truth = {c.t, c.instance, c.primitive};
    return truth;
}

bool isMiss(const shared::HitData& claim) { return claim.t < 0.0f; }

}  // namespace

struct HitOracle::Geometry {
    explicit Geometry(const Scene& scene_)
        : scene(scene_), trees(meshTrees(scene)), placements(placementsOf(scene)), top(boxes()) {
        for (const Placement& placement : placements)
            worstTransform = std::max(worstTransform, placement.thereAndBackNorm);
    }

    const PaddedTree& treeOf(const Placement& placement) const {
        return trees[scene.instances[placement.instance].mesh];
    }
    /// Of the placements, widened by the rounding of their transforms as far as it does not depend on the ray.
    std::vector<Box> boxes() const;
    Gathered gather(const shared::RayData& data, uint32_t key) const;
    void gatherFrom(const WorldRay& ray, const Placement& placement, uint32_t key, Gathered& gathered) const;

    const Scene& scene;
    std::vector<PaddedTree> trees;  ///< of the meshes, in object space
    std::vector<Placement> placements;
    PaddedTree top;  ///< over the placements
    double worstTransform = 0.0;
};

std::vector<Box> HitOracle::Geometry::boxes() const {
    std::vector<Box> result;
    for (const Placement& placement : placements) {
        Box box = worldBox(treeOf(placement).bounds(), placement.toWorld);
        const double pad = oracle::kWalkRoundings * oracle::kRounding *
                           placement.transformMagnitude(treeOf(placement).bounds().farthest(), glm::dvec3(0.0), 0.0);
        if (!box.isEmpty()) box = {box.lo - pad, box.hi + pad};
        result.push_back(box);
    }
    return result;
}

void HitOracle::Geometry::gatherFrom(const WorldRay& ray, const Placement& placement, uint32_t key,
                                     Gathered& gathered) const {
    const PaddedTree& tree = treeOf(placement);
    const auto consider = [&](std::optional<Candidate> candidate) {
        if (!candidate) return;
        applyAlpha(scene, placement, key, *candidate);
        if (candidate->certainty == Certainty::certain) gathered.barrier = std::min(gathered.barrier, candidate->high);
        gathered.candidates.push_back(*candidate);
    };
    tree.walk(paddedObjectRay(ray, placement, tree.bounds().farthest()), gathered.barrier, [&](uint32_t i) {
        if (placement.mesh->quadrics.empty()) {
            consider(intersectTriangle(ray, placement, i));
        } else {
            for (const std::optional<Candidate>& candidate : intersectQuadric(ray, placement, i)) consider(candidate);
        }
    });
}

Gathered HitOracle::Geometry::gather(const shared::RayData& data, uint32_t key) const {
    const WorldRay ray(data);
    Gathered gathered;
    if (!std::isfinite(ray.length) || ray.length == 0.0) return gathered;
    const double scale = oracle::kWalkRoundings * oracle::kRounding;
    const glm::dvec3 size = glm::abs(ray.origin);
    top.walk({ray.origin, ray.direction, ray.tMin, scale * (1.0 + worstTransform),
              scale * worstTransform * std::max({size.x, size.y, size.z})},
             gathered.barrier, [&](uint32_t i) { gatherFrom(ray, placements[i], key, gathered); });
    gathered.barrier = std::min(gathered.barrier, oracle::coveredBy(gathered.candidates));
    return gathered;
}

HitOracle::HitOracle(const Scene& scene) : geometry_(std::make_unique<Geometry>(scene)) {}

HitOracle::~HitOracle() = default;

TrueHit HitOracle::closest(const shared::RayData& ray, uint32_t key) const {
    return truthOf(geometry_->gather(ray, key));
}

Judgement HitOracle::judgeClosest(const shared::RayData& ray, uint32_t key, const shared::HitData& a,
                                  const shared::HitData& b) const {
    const Gathered gathered = geometry_->gather(ray, key);
    const Candidate* const hitA = isMiss(a) ? nullptr : rightHit(gathered, a);
    const Candidate* const hitB = isMiss(b) ? nullptr : rightHit(gathered, b);
    const bool aRight = isMiss(a) ? mayMiss(gathered) : hitA != nullptr;
    const bool bRight = isMiss(b) ? mayMiss(gathered) : hitB != nullptr;
    const bool sameSurface = hitA != nullptr && hitB != nullptr && hitA->low <= hitB->high && hitB->low <= hitA->high;
    return {verdictOf(aRight, bRight, sameSurface || (isMiss(a) && isMiss(b))), truthOf(gathered)};
}

Judgement HitOracle::judgeOccluded(const shared::RayData& ray, uint32_t key, const shared::HitData& a,
                                   const shared::HitData& b) const {
    const Gathered gathered = geometry_->gather(ray, key);
    const auto isRight = [&](const shared::HitData& claim) {
        return isMiss(claim) ? mayMiss(gathered) : mayHit(gathered);
    };
    return {verdictOf(isRight(a), isRight(b), isMiss(a) == isMiss(b)), truthOf(gathered)};
}

double HitOracle::facing(const shared::RayData& data, const shared::HitData& hit) const {
    const WorldRay ray(data);
    const auto placement = std::ranges::lower_bound(geometry_->placements, hit.instance, {}, &Placement::instance);
    if (placement == geometry_->placements.end() || placement->instance != hit.instance) return 0.0;
    const glm::dvec3 normal = oracle::normalAt(*placement, hit.primitive, ray.at(static_cast<double>(hit.t)));
    const double lengths = glm::length(normal) * ray.length;
    return lengths > 0.0 ? std::abs(glm::dot(normal, ray.direction)) / lengths : 0.0;
}

}  // namespace raylab
