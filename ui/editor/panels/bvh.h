#pragma once

#include "ui/editor/bvh_state.h"

namespace raylab {

// Parts of the BVH panel, one file each.

/// The tree from its root on, as far as it has been opened.
void drawTreeView(BvhState& state);

/// Figures of each tree: SAH, EPO, depth, leaves, memory.
void drawTreeFigures(BvhState& state, const Scene& scene);

/// The choice of a second build, and its difference from that of the settings.
void drawTwoBuilds(BvhState& state);

/// "inner", "leaf" or "instance", and which.
std::string nodeName(const TreeInspection& trees, const TreeNode& at);

}  // namespace raylab
