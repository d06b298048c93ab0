#include "ui/editor/model/transform_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace raylab::editor {
namespace {

constexpr double kMostShear = 1e-4;  ///< cosine between columns; what single precision makes of a long chain of turns
constexpr double kGimbalLock = 1.0 - 1e-12;

/// R = Rz Ry Rx: its entries give the angles (G. G. Slabaugh, "Computing Euler angles from a rotation matrix", 1999).
glm::dvec3 eulerDegrees(const glm::dmat3& r) {
    const double sinY = std::clamp(-r[0][2], -1.0, 1.0);
    glm::dvec3 angles(0.0, std::asin(sinY), 0.0);
    if (std::abs(sinY) < kGimbalLock) {
        angles.x = std::atan2(r[1][2], r[2][2]);
        angles.z = std::atan2(r[0][1], r[0][0]);
    } else {
        angles.z = std::atan2(-r[1][0], r[1][1]);  // x and z turn about one axis: z takes all of it
    }
    return glm::degrees(angles);
}

}  // namespace

std::optional<TransformParts> partsOf(const glm::mat4& matrix) {
    const glm::dmat4 m(matrix);
    glm::dmat3 axes(m);
    TransformParts parts;
    parts.translation = glm::dvec3(m[3]);
    for (int c = 0; c < 3; ++c) {
        parts.scale[c] = glm::length(axes[c]);
        if (!(parts.scale[c] > 0.0)) return std::nullopt;
        axes[c] /= parts.scale[c];
    }
    for (int c = 0; c < 3; ++c)
        if (std::abs(glm::dot(axes[c], axes[(c + 1) % 3])) > kMostShear) return std::nullopt;
    if (glm::determinant(axes) < 0.0) {
        parts.scale.x = -parts.scale.x;
        axes[0] = -axes[0];
    }
    parts.rotationDegrees = eulerDegrees(axes);
    return parts;
}

glm::mat4 matrixOf(const TransformParts& parts) {
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), parts.translation);
    m = glm::rotate(m, glm::radians(parts.rotationDegrees.z), glm::dvec3(0, 0, 1));
    m = glm::rotate(m, glm::radians(parts.rotationDegrees.y), glm::dvec3(0, 1, 0));
    m = glm::rotate(m, glm::radians(parts.rotationDegrees.x), glm::dvec3(1, 0, 0));
    return glm::mat4(glm::scale(m, parts.scale));
}

}  // namespace raylab::editor
