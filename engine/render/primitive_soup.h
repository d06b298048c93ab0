#pragma once

#include <cstdint>
#include <vector>

#include "engine/accel/aabb.h"
#include "engine/scene/bounds.h"
#include "engine/scene/needs.h"
#include "shaders/shared/scene.h"

namespace raylab {

/// Primitives in their own order, before a tree sorts them: triangles, then quadrics.
struct PrimitiveSoup {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    std::vector<shared::TraceTriangle> records;
    std::vector<shared::TraceTriangle> quadricRecords;
    std::vector<shared::TraceQuadric> quadrics;
    std::vector<Aabb> quadricBounds;
};

/// All meshes that the plan merges, in world space.
PrimitiveSoup mergedSoup(const Scene& scene, const TreePlan& plan);

/// The primitives of one mesh in its own space.
PrimitiveSoup meshSoup(const Scene& scene, uint32_t mesh);

/// A soup's primitives as one list: of a quadric the builders know its box alone.
struct SoupInput {
    std::vector<Aabb> bounds;
    std::vector<glm::uvec3> triangles;

    explicit SoupInput(const PrimitiveSoup& soup);
};

/// Widened by the rounding of a hit's coordinates; empty where the box is.
Aabb widened(const Bounds& box);

}  // namespace raylab
