#include "engine/measure/ray_walk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/accel/layout_frame.h"
#include "engine/accel/triangle_watertight.h"
#include "engine/accel/walk_slab.h"

namespace raylab {
namespace {

/// How far a bounce begins from its surface, as a part of the largest coordinate there: floats of positions end at
/// 6e-8.
constexpr float kBounceOffset = 1e-5f;

/// The ray in the space of the tree that it is in.
struct LocalRay {
    glm::vec3 origin, direction, reciprocal;
    WatertightRay watertight;

    LocalRay(const glm::vec3& o, const glm::vec3& d)
        : origin(o), direction(d), reciprocal(slabReciprocal(d)), watertight(makeWatertightRay(o, d)) {}
};

/// The closest root of a quadric's equation in (tMin, tMax] between its clip planes; both are tried, the near one
/// first.
std::optional<double> quadricHit(const shared::TraceQuadric& q, const LocalRay& ray, double tMin, double tMax) {
    const auto place = [&](const glm::vec3& p, double w) {
        const glm::dvec4 h(glm::dvec3(p), w);
        return glm::dvec3(glm::dot(glm::dvec4(q.toCanonical0), h), glm::dot(glm::dvec4(q.toCanonical1), h),
                          glm::dot(glm::dvec4(q.toCanonical2), h));
    };
    const glm::dvec3 o = place(ray.origin, 1.0), d = place(ray.direction, 0.0),
                     form(1.0, 1.0, static_cast<double>(q.zz));
    const auto z = static_cast<double>(q.z);
    const double a = glm::dot(form * d, d), halfB = glm::dot(form * o, d) + 0.5 * z * d.z;
    const double c = glm::dot(form * o, o) + z * o.z + static_cast<double>(q.constant);
    const double discriminant = halfB * halfB - a * c;
    if (discriminant < 0.0) return {};
    const double sum = -(halfB + std::copysign(std::sqrt(discriminant), halfB));
    std::array<double, 2> roots{sum / a, c / sum};  // the form without cancellation; a root at infinity fails the range
    if (!(roots[0] <= roots[1])) std::swap(roots[0], roots[1]);
    for (const double t : roots) {
        const double height = o.z + t * d.z;
        if (t > tMin && t <= tMax && height >= static_cast<double>(q.clipLow) &&
            height <= static_cast<double>(q.clipHigh))
            return t;
    }
    return {};
}

glm::vec3 quadricNormal(const shared::TraceQuadric& q, const glm::vec3& point) {
    const glm::vec4 h(point, 1.0f);
    const float height = glm::dot(q.toCanonical2, h);
    const glm::vec3 gradient(2.0f * glm::dot(q.toCanonical0, h), 2.0f * glm::dot(q.toCanonical1, h),
                             2.0f * q.zz * height + q.z);
    return gradient.x * glm::vec3(q.toCanonical0) + gradient.y * glm::vec3(q.toCanonical1) +
           gradient.z * glm::vec3(q.toCanonical2);
}

class Walker {
public:
    Walker(const TreeInspection& trees, const WalkRay& ray)
        : trees_(trees), world_(ray.origin, ray.direction), local_(world_), tBest_(ray.tMax) {
        walk_.ray = ray;
    }

    RayWalk run() {
        if (!trees_.empty()) {
            std::optional<TreeNode> next = trees_.root();
            if (next->tree != kUpperTree) enter(*next);
            while (next) next = step(*next);
        }
        return std::move(walk_);
    }

private:
    void enter(const TreeNode& at) {
        const glm::mat4& m = trees_.placements[at.placement].toObject;
        const bool isIdentity = at.tree == kUpperTree || trees_.instance(at) == shared::kInheritInstance;
        local_ = isIdentity
                     ? world_
                     : LocalRay(glm::vec3(m * glm::vec4(walk_.ray.origin, 1.0f)), glm::mat3(m) * walk_.ray.direction);
    }

    /// What comes after it; nothing at the end.
    std::optional<TreeNode> step(const TreeNode& at) {
        WalkStep record{.at = at};
        std::optional<TreeNode> next;
        const BvhNode& node = trees_.node(at);
        if (!node.isLeaf())
            next = testChildren(at, record);
        else if (at.tree == kUpperTree)
            next = enterInstance(at, record);
        else
            testPrimitives(at, record);
        if (!next && !stack_.empty()) {
            next = stack_.back();
            stack_.pop_back();
            if (next->tree != at.tree || next->placement != at.placement) enter(*next);
        }
        record.stack = stack_;
        record.tBest = tBest_;
        walk_.steps.push_back(std::move(record));
        return next;
    }

    BoxTest testBox(const TreeNode& at) const {
        const Aabb box = paddedBox(trees_.node(at).bounds);
        const glm::vec3 t0 = (box.lo - local_.origin) * local_.reciprocal,
                        t1 = (box.hi - local_.origin) * local_.reciprocal;
        BoxTest test{.at = at};
        test.hit = slabHit(t0, t1, walk_.ray.tMin, tBest_, test.tNear);
        const glm::vec3 leave = glm::max(t0, t1);
        test.tFar = std::min({leave.x, leave.y, leave.z});
        return test;
    }

    std::optional<TreeNode> testChildren(const TreeNode& at, WalkStep& record) {
        const std::vector<TreeNode> children = trees_.children(at);
        const BoxTest left = testBox(children[0]), right = testBox(children[1]);
        record.boxes = {left, right};
        if (!left.hit && !right.hit) return {};
        const bool leftFirst = left.hit && (!right.hit || left.tNear <= right.tNear);
        if (left.hit && right.hit) stack_.push_back(leftFirst ? right.at : left.at);
        return leftFirst ? left.at : right.at;
    }

    /// Into the first of the trees that the leaf holds; the others wait.
    TreeNode enterInstance(const TreeNode& at, WalkStep& record) {
        record.kind = WalkKind::instance;
        const std::vector<TreeNode> roots = trees_.children(at);
        for (size_t i = roots.size(); i-- > 1;) stack_.push_back(roots[i]);
        enter(roots[0]);
        return roots[0];
    }

    void testPrimitives(const TreeNode& at, WalkStep& record) {
        record.kind = WalkKind::leaf;
        const BvhNode& node = trees_.node(at);
        const uint32_t first = trees_.data.trees[at.tree].firstSlot + node.first;
        for (uint32_t slot = first; slot < first + node.count; ++slot) {
            PrimitiveTest test = testPrimitive(at, slot);
            test.hit = test.hit && isCloser(test);
            record.primitives.push_back(test);
            if (!test.hit) continue;
            tBest_ = test.t;
            walk_.hit = test;
            walk_.normal = normalAt(at, test);
        }
    }

    PrimitiveTest testPrimitive(const TreeNode& at, uint32_t slot) const {
        const shared::TraceTriangle& record = trees_.data.triangles[slot];
        PrimitiveTest test{.slot = slot, .primitive = record.primitive};
        test.isQuadric = (record.instance & shared::kSlotIsQuadric) != 0;
        test.instance = record.instance & ~shared::kSlotIsQuadric;
        if (test.instance == shared::kInheritInstance) test.instance = trees_.instance(at);
        if (test.isQuadric) {
            const auto t =
                quadricHit(quadricOf(record), local_, static_cast<double>(walk_.ray.tMin), static_cast<double>(tBest_));
            test.hit = t.has_value();
            test.t = static_cast<float>(t.value_or(0.0));
        } else {
            test.hit = intersectWatertight(local_.watertight, record.p0, record.p1, record.p2, walk_.ray.tMin, tBest_,
                                           test.t, test.u, test.v);
        }
        return test;
    }

    /// At the same distance the lowest id wins, so that hits do not depend on the order of the walk.
    bool isCloser(const PrimitiveTest& test) const {
        if (!walk_.hit || test.t < walk_.hit->t) return true;
        return std::pair(test.instance, test.primitive) < std::pair(walk_.hit->instance, walk_.hit->primitive);
    }

    const shared::TraceQuadric& quadricOf(const shared::TraceTriangle& record) const {
        return trees_.data.quadrics[glm::floatBitsToUint(record.p0.x)];
    }

    glm::vec3 normalAt(const TreeNode& at, const PrimitiveTest& test) const {
        const shared::TraceTriangle& t = trees_.data.triangles[test.slot];
        const glm::vec3 local = test.isQuadric ? quadricNormal(quadricOf(t), local_.origin + test.t * local_.direction)
                                               : glm::cross(t.p1 - t.p0, t.p2 - t.p0);
        const glm::vec3 world =
            glm::normalize(glm::transpose(glm::mat3(trees_.placements[at.placement].toObject)) * local);
        return glm::dot(world, walk_.ray.direction) > 0.0f ? -world : world;
    }

    const TreeInspection& trees_;
    LocalRay world_, local_;
    float tBest_;
    std::vector<TreeNode> stack_;
    RayWalk walk_;
};

/// From the hit on, a little off the surface.
WalkRay rayFrom(const RayWalk& walk, const glm::vec3& direction) {
    const glm::vec3 point = walk.ray.origin + walk.hit->t * walk.ray.direction;
    const glm::vec3 size = glm::max(glm::abs(point), glm::abs(walk.ray.origin));
    const float offset = kBounceOffset * std::max({size.x, size.y, size.z});
    return {point + offset * walk.normal, direction, 0.0f, 3.0e38f};
}

}  // namespace

RayWalk walkRay(const TreeInspection& trees, const WalkRay& ray) { return Walker(trees, ray).run(); }

std::optional<WalkRay> mirrorBounce(const RayWalk& walk) {
    if (!walk.hit) return {};
    return rayFrom(walk, glm::reflect(glm::normalize(walk.ray.direction), walk.normal));
}

std::optional<WalkRay> diffuseBounce(const RayWalk& walk, float u0, float u1) {
    if (!walk.hit) return {};
    const glm::vec3 n = walk.normal;
    const glm::vec3 side =
        glm::normalize(glm::cross(std::abs(n.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), n));
    const float radius = std::sqrt(u0), angle = 6.2831853f * u1;
    const glm::vec3 across = std::cos(angle) * side + std::sin(angle) * glm::cross(n, side);
    return rayFrom(walk, radius * across + std::sqrt(1.0f - u0) * n);
}

}  // namespace raylab
