#include "ui/editor/model/gizmo_view.h"

#include <algorithm>
#include <cmath>

namespace raylab::editor {
namespace {

constexpr double kNearest = 1e-6;  ///< depth from which on a point has a pixel
constexpr double kAlongUp = 1e-6;

}  // namespace

GizmoView::GizmoView(const Camera& camera, double width, double height)
    : position_(camera.position),
      forward_(glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position))),
      halfHeight_(std::tan(0.5 * static_cast<double>(camera.fovYRadians))),
      width_(width),
      height_(height) {
    glm::dvec3 up(camera.up);
    if (glm::length(glm::cross(forward_, up)) < kAlongUp)
        up = std::abs(forward_.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    right_ = glm::normalize(glm::cross(forward_, up));
    up_ = glm::cross(right_, forward_);
}

std::optional<glm::dvec2> GizmoView::project(const glm::dvec3& world) const {
    const glm::dvec3 offset = world - position_;
    const double depth = glm::dot(offset, forward_);
    if (depth < kNearest) return std::nullopt;
    const double pixels = 0.5 * height_ / (halfHeight_ * depth);
    return glm::dvec2(0.5 * width_ + glm::dot(offset, right_) * pixels, 0.5 * height_ - glm::dot(offset, up_) * pixels);
}

ViewRay GizmoView::ray(const glm::dvec2& pixel) const {
    const double scale = 2.0 * halfHeight_ / height_;
    const glm::dvec3 direction =
        forward_ + right_ * ((pixel.x - 0.5 * width_) * scale) - up_ * ((pixel.y - 0.5 * height_) * scale);
    return {position_, glm::normalize(direction)};
}

double GizmoView::worldPerPixel(const glm::dvec3& world) const {
    return 2.0 * halfHeight_ * std::max(glm::dot(world - position_, forward_), kNearest) / height_;
}

}  // namespace raylab::editor
