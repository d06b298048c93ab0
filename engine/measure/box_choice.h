#pragma once

#include <atomic>
#include <glm/glm.hpp>
#include <vector>

#include "engine/measure/tree_inspection.h"

namespace raylab {

/// The view that boxes are chosen for: rows of a projection without its depth. A point p of the world, with 1 as its
/// fourth component, is at (x . p, y . p) / (w . p), which is -1 .. 1 within the picture, and before the camera where
/// w . p > 0.
struct BoxView {
    glm::vec4 x{1, 0, 0, 0}, y{0, 1, 0, 0}, w{0, 0, 1, 0};
};

/// Part of the picture that the rectangle around a node's box takes, 0 .. 1: 0 where it is not in view, 1 where the box
/// reaches behind the camera without being all behind it.
double areaInView(const TreeInspection& trees, const TreeNode& at, const BoxView& view);

/// The boxes of a filter that are largest in view, largest first, `limit` at most, without those that are out of view.
/// A child's rectangle lies within its parent's, so a search from the root that always opens the largest comes upon
/// them in this order. `cancel`, once true, ends it by throwing Cancelled.
std::vector<TreeNode> largestInView(const TreeInspection& trees, const BoxFilter& filter, const BoxView& view,
                                    size_t limit, const std::atomic<bool>* cancel = nullptr);

/// From the root to the node, both included.
std::vector<TreeNode> pathTo(const TreeInspection& trees, const TreeNode& at);

}  // namespace raylab
