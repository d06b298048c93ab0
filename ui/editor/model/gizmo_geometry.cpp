#include "ui/editor/model/gizmo_geometry.h"

#include <cmath>

namespace raylab::editor {
namespace {

constexpr double kSineOf8Degrees = 0.139173;
constexpr double kParallel = 1e-9;

}  // namespace

bool isArmVisible(const GizmoView& view, const GizmoPose& pose, int axis) {
    const glm::dvec3 sight = glm::normalize(pose.origin - view.position());
    return glm::length(glm::cross(sight, pose.axes[axis])) > kSineOf8Degrees;
}

bool isPlaneVisible(const GizmoView& view, const GizmoPose& pose, const glm::dvec3& normal) {
    return std::abs(glm::dot(glm::normalize(pose.origin - view.position()), normal)) > kSineOf8Degrees;
}

std::optional<double> nearestOnLine(const ViewRay& ray, const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dvec3 between = origin - ray.origin;
    const double cosine = glm::dot(ray.direction, direction);
    const double sineSquared = 1.0 - cosine * cosine;
    if (sineSquared < kParallel) return std::nullopt;
    const double alongRay = glm::dot(between, ray.direction), alongLine = glm::dot(between, direction);
    if ((alongRay - cosine * alongLine) / sineSquared <= 0.0) return std::nullopt;
    return (cosine * alongRay - alongLine) / sineSquared;
}

std::optional<glm::dvec3> hitPlane(const ViewRay& ray, const glm::dvec3& origin, const glm::dvec3& normal) {
    const double slope = glm::dot(ray.direction, normal);
    if (std::abs(slope) < kParallel) return std::nullopt;
    const double t = glm::dot(origin - ray.origin, normal) / slope;
    if (!(t > 0.0)) return std::nullopt;
    return ray.origin + ray.direction * t;
}

}  // namespace raylab::editor
