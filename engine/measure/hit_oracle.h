#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>

#include "engine/scene/scene.h"
#include "shaders/shared/frame.h"

namespace raylab {

/// The closest hit in double precision, all numbers of ray and scene taken as exact.
struct TrueHit {
    double t = std::numeric_limits<double>::infinity();
    uint32_t instance = 0;
    uint32_t primitive = 0;

    bool hit() const { return t < std::numeric_limits<double>::infinity(); }
};

/// Who is right of two that answered for the same ray.
enum class Verdict {
    aRight,
    bRight,
    neither,
    tie,          ///< both: the same surface, or two that no float can tell apart there (coplanar, a shared edge)
    undecidable,  ///< both: hit and miss, or surfaces apart, and the ray passes an edge closer than rounding can tell
};

struct Judgement {
    Verdict verdict = Verdict::tie;
    TrueHit truth;
};

/// Judges hits that float tracers claim, in double precision over a tree of its own (median split, padded boxes), which
/// shares nothing with those of engine/accel.
///
/// The tolerance is an error bound, not a constant. A tracer that is right works in float: it may see a ray or a
/// surface moved across the ray by
///     margin = sqrt(3) 2^-24 (12 R + 5 T),
/// R being the largest coordinate of the primitive as seen from the ray's origin and T the sums of magnitudes that go
/// into the instance's transform (0 where that is the identity); 12 and 5 count the roundings on the way of a
/// triangle's coordinate, 16 in place of 12 and the roundings of the equation that of a quadric's. By this margin a
/// primitive is hit for certain, possibly, or not, and its t becomes an interval: as wide as t changes across the
/// margin, so wide where the surface is seen at a grazing angle, and never wider than the primitive. A claimed hit is
/// right where its primitive is at least possible, its t within the interval, and nothing is certain to be closer; a
/// claimed miss where nothing is certain to be hit.
///
/// No surface is open at an edge that two triangles share: where a ray comes close to such edges only, and the
/// triangles around it cover it an odd number of times, it hits for certain (the degree, modulo two, of the projection
/// along the ray does not change unless the border passes the ray), and all of these triangles are right answers. So
/// leaks between neighbours are found, whereas a silhouette is undecidable. Corners are the same where their world
/// positions are, whichever mesh they belong to; where surfaces only abut (T-junctions), a leak is undecidable.
///
/// Alpha is decided by the rule of acceptsCandidate() in shaders/trace/common.glsl in double precision: bilinear alpha
/// of level 0 against the cutoff, or for blending against the hash of key, instance and primitive. A hit is merely
/// possible where the margin can change that, and on quadrics with a texture. Singular instances, triangles without
/// area and non-finite ones are never hit.
class HitOracle {
public:
    /// `scene` must outlive the oracle.
    explicit HitOracle(const Scene& scene);
    ~HitOracle();
    HitOracle(const HitOracle&) = delete;
    HitOracle& operator=(const HitOracle&) = delete;

    /// `key` decides blended alpha: of a ray traced by a RayCaster, its index in its dispatch.
    TrueHit closest(const shared::RayData& ray, uint32_t key = 0) const;
    /// Of two answers to the closest hit, as RayCaster::closest() gives them.
    Judgement judgeClosest(const shared::RayData& ray, uint32_t key, const shared::HitData& a,
                           const shared::HitData& b) const;
    /// Of two answers to any hit, as RayCaster::occluded() gives them: only the sign of t counts.
    Judgement judgeOccluded(const shared::RayData& ray, uint32_t key, const shared::HitData& a,
                            const shared::HitData& b) const;
    /// Cosine, without sign, between the ray and the geometric normal where `hit` says that it met a surface.
    double facing(const shared::RayData& ray, const shared::HitData& hit) const;

private:
    struct Geometry;
    std::unique_ptr<const Geometry> geometry_;
};

}  // namespace raylab
