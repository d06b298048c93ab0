#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "engine/scene/scene.h"

namespace raylab::editor {

struct ViewRay {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};  ///< unit
};

/// A camera with an image of some size: from the world to pixels and back, as the kernels see it (writeCamera). Pixel
/// (0,0) is the upper left corner of the image; pixels have fractions.
class GizmoView {
public:
    GizmoView(const Camera& camera, double width, double height);

    /// Nothing for a point behind the camera.
    std::optional<glm::dvec2> project(const glm::dvec3& world) const;
    ViewRay ray(const glm::dvec2& pixel) const;

    /// World length of a pixel at the depth of a point.
    double worldPerPixel(const glm::dvec3& world) const;
    const glm::dvec3& position() const { return position_; }
    const glm::dvec3& forward() const { return forward_; }
    const glm::dvec3& right() const { return right_; }
    const glm::dvec3& up() const { return up_; }

private:
    glm::dvec3 position_, forward_, right_, up_;  ///< the last three are unit vectors
    double halfHeight_;                           ///< tangent of half the vertical field of view
    double width_, height_;                       ///< pixels
};

}  // namespace raylab::editor
