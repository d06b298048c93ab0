#pragma once

#include <map>
#include <string>

#include "ui/editor/context.h"

namespace raylab {

// What menus and keys do with the trees, and with what is counted.

void toggleBoxes(EditorContext& context);
bool showsBoxes(const EditorContext& context);
void toggleCounts(EditorContext& context);
bool showsCounts(const EditorContext& context);
void startPicking(EditorContext& context);
void stepForward(EditorContext& context);
void stepBack(EditorContext& context);
bool hasRay(const EditorContext& context);

/// Messages of the validation layers about counting.
uint32_t countingValidationMessages(const EditorContext& context);

/// What a script may check of them: bvh-busy, bvh-sah, bvh-epo and bvh-nodes (of the tree with the most primitives),
/// bvh-boxes (drawn), bvh-boxes-wanted, bvh-selected (depth of the node, -1: none), bvh-selected-leaf, bvh-b-sah,
/// ray-bounces, ray-step, ray-steps, ray-stack, ray-tested (primitives of the step), ray-hit, counts-busy, counts-rays,
/// counts-mean, counts-most, counts-low and counts-high (of the colours). 0 where there is nothing, -1 for an EPO that
/// is not known.
std::map<std::string, double> inspectionNumbers(const EditorContext& context);

}  // namespace raylab
