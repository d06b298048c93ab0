#pragma once

#include <string>

#include "engine/measure/ray_walk.h"

namespace raylab {

/// Every node of every tree once, a line each below a header line: tree ("upper" or its index), node, parent (empty for
/// a root), left child (empty for a leaf; the right one is its neighbour), depth in its tree, leaf (0 or 1),
/// primitives, first_slot, sah_share, sibling_overlap, and the corners of its box in the space of its tree.
std::string nodeListCsv(const TreeInspection& trees);

/// A walk as one object, schema "raylab.ray-walk/1": the ray, `steps` with what walkRay() recorded of each, and `hit`,
/// which is null where nothing was hit. Boxes of steps are those of the space that the ray is in there.
std::string walkJson(const TreeInspection& trees, const RayWalk& walk);

}  // namespace raylab
