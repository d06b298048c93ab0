#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/measure/tree_inspection.h"

namespace raylab {

/// A ray to be walked; t counts in lengths of the direction.
struct WalkRay {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f, 0.0f, 1.0f};  ///< of any length but zero
    float tMin = 0.0f;
    float tMax = 3.0e38f;
};

enum class WalkKind {
    inner,     ///< the boxes of both children are tested
    instance,  ///< a leaf of the upper tree: the ray goes into the space of what it holds
    leaf,      ///< the primitives are tested
};

/// A child's box against the ray.
struct BoxTest {
    TreeNode at;
    float tNear = 0.0f;  ///< where the ray enters; tMin where it begins inside
    float tFar = 0.0f;   ///< where it leaves; before tNear where it passes by
    bool hit = false;    ///< before the closest hit so far, with the padding of kSlabPad
};

/// A primitive against the ray.
struct PrimitiveTest {
    uint32_t slot = 0;  ///< of TraceData::triangles
    uint32_t instance = 0;
    uint32_t primitive = 0;  ///< within its mesh
    bool isQuadric = false;
    bool hit = false;  ///< closer than all before, or as close with a lower id
    float t = 0.0f, u = 0.0f, v = 0.0f;
};

/// One turn of the traversal's loop.
struct WalkStep {
    WalkKind kind = WalkKind::inner;
    TreeNode at;
    std::vector<BoxTest> boxes;             ///< of an inner node: left child, right child
    std::vector<PrimitiveTest> primitives;  ///< of a leaf
    std::vector<TreeNode> stack;            ///< after the step, the bottom first
    float tBest = 0.0f;                     ///< after the step: of the closest hit, else tMax
};

struct RayWalk {
    WalkRay ray;
    std::vector<WalkStep> steps;
    std::optional<PrimitiveTest> hit;  ///< the closest
    glm::vec3 normal{
        0.0f};  ///< there, in the world, of length 1, geometric, towards the origin; (0, 0, 0) without a hit
};

/// Walks the binary trees as the software traversal does (while-while, Aila and Laine 2009): boxes of both children,
/// the nearer first, the other onto the stack, no test when it is popped; padded slabs and the watertight triangle test
/// in float. Surfaces with alpha count as opaque.
RayWalk walkRay(const TreeInspection& trees, const WalkRay& ray);

/// The ray on from a walk's hit: about the normal by the mirror's law, or with the cosine's density by two numbers in
/// [0, 1) (Malley's method). Nothing without a hit.
std::optional<WalkRay> mirrorBounce(const RayWalk& walk);
std::optional<WalkRay> diffuseBounce(const RayWalk& walk, float u0, float u1);

}  // namespace raylab
