#pragma once

#include <glm/glm.hpp>

#include "engine/scene/scene.h"

namespace raylab {

/// Whether the instance is elsewhere where the shutter closes.
bool moves(const Instance& instance);

/// Its transform at `time`, 0 where the shutter opens and 1 where it closes: matrices are interpolated, so that each
/// point moves in a straight line, and what turns by an angle a is cos(a/2) as large halfway.
glm::mat4 transformAt(const Instance& instance, float time);

/// Whether every matrix between the two can be inverted: a turn by half flattens what turns.
bool isInvertibleBetween(const glm::mat4& start, const glm::mat4& end);

}  // namespace raylab
