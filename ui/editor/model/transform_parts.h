#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace raylab::editor {

/// A transform as one types it: scale first, then turn about x, y and z in this order, then move.
struct TransformParts {
    glm::dvec3 translation{0.0};
    glm::dvec3 rotationDegrees{0.0};  ///< y between -90 and 90, x and z between -180 and 180
    glm::dvec3 scale{1.0};
};

/// Nothing where the matrix shears, to 1e-4: then it has no such parts. A mirror image has a negative scale in x.
std::optional<TransformParts> partsOf(const glm::mat4& matrix);

glm::mat4 matrixOf(const TransformParts& parts);

}  // namespace raylab::editor
