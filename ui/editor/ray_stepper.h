#pragma once

#include "ui/editor/bvh_state.h"

namespace raylab {

/// The leaf in which a walk found what it hit.
std::optional<TreeNode> leafOfHit(const RayWalk& walk);

/// A walk becomes the one that is stepped through, from its first step on.
void startRay(BvhState& state, RayWalk walk);

/// Walks the stepper's rays again where the shown trees are others.
void keepRay(BvhState& state);

/// Steps forward or back; nothing happens beyond the ends.
void stepRay(RaySteps& ray, int steps);

/// From where the ray of the current bounce hits; bounces that came after it are forgotten. False where it misses.
enum class BounceKind { mirror, diffuse };
bool bounceRay(RaySteps& ray, BounceKind kind);

/// The walk of the current bounce as JSON, or all nodes as CSV, into the first free file of the current folder, in the
/// background.
void exportWalk(EditorContext& context);
void exportNodes(EditorContext& context);

}  // namespace raylab
