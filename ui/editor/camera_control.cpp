#include "ui/editor/camera_control.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace raylab {
namespace {

constexpr float kSteepest = 1.553343f;  ///< 89 degrees: beyond, the horizon has no direction
constexpr float kMargin = 1.15f;        ///< around a box that is framed

glm::vec3 worldUp(const Camera& camera) {
    const float length = glm::length(camera.up);
    return length > 0.0f ? camera.up / length : glm::vec3(0.0f, 1.0f, 0.0f);
}

/// `direction` turned about the up axis and raised, its elevation within bounds.
glm::vec3 turned(const Camera& camera, const glm::vec3& direction, float right, float up) {
    const glm::vec3 axis = worldUp(camera);
    const float elevation = std::asin(std::clamp(glm::dot(direction, axis), -1.0f, 1.0f));
    const float raised = std::clamp(elevation + up, -kSteepest, kSteepest) - elevation;
    const glm::vec3 side = cameraAxes({"", glm::vec3(0.0f), direction, camera.up, camera.fovYRadians}).right;
    const glm::quat lift = glm::angleAxis(raised, side);
    return glm::normalize(glm::angleAxis(-right, axis) * (lift * direction));
}

}  // namespace

CameraAxes cameraAxes(const Camera& camera) {
    const glm::vec3 ahead = glm::normalize(camera.target - camera.position);
    glm::vec3 up = worldUp(camera);
    if (glm::length(glm::cross(ahead, up)) < 1e-4f)
        up = std::abs(ahead.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 right = glm::normalize(glm::cross(ahead, up));
    return {right, glm::cross(right, ahead), ahead};
}

void lookAround(Camera& camera, float right, float up) {
    const glm::vec3 view = camera.target - camera.position;
    const float distance = glm::length(view);
    camera.target = camera.position + distance * turned(camera, view / distance, right, up);
}

void orbit(Camera& camera, float right, float down) {
    const glm::vec3 view = camera.target - camera.position;
    const float distance = glm::length(view);
    camera.position = camera.target - distance * turned(camera, view / distance, right, -down);
}

void dolly(Camera& camera, float factor) {
    camera.position = camera.target + factor * (camera.position - camera.target);
}

void fly(Camera& camera, const glm::vec3& rightUpAhead) {
    const CameraAxes axes = cameraAxes(camera);
    const glm::vec3 step = rightUpAhead.x * axes.right + rightUpAhead.y * axes.up + rightUpAhead.z * axes.ahead;
    camera.position += step;
    camera.target += step;
}

void setPivot(Camera& camera, const glm::vec3& pivot) {
    if (glm::distance(pivot, camera.position) > 0.0f) camera.target = pivot;
}

void frameBox(Camera& camera, const Bounds& box, float aspect) {
    const glm::vec3 centre = 0.5f * (box.lo + box.hi);
    const float radius = std::max(0.5f * glm::length(box.hi - box.lo), 1e-6f);
    const float halfY = 0.5f * camera.fovYRadians;
    const float half = std::min(halfY, std::atan(std::tan(halfY) * aspect));
    const glm::vec3 ahead = cameraAxes(camera).ahead;
    camera.target = centre;
    camera.position = centre - ahead * (kMargin * radius / std::sin(half));
}

glm::vec3 projectPoint(const Camera& camera, float aspect, const glm::vec3& point) {
    const CameraAxes axes = cameraAxes(camera);
    const glm::vec3 view = point - camera.position;
    const float depth = glm::dot(view, axes.ahead);
    const float halfY = std::tan(0.5f * camera.fovYRadians);
    const float x = glm::dot(view, axes.right) / (depth * halfY * aspect),
                y = glm::dot(view, axes.up) / (depth * halfY);
    return {0.5f + 0.5f * x, 0.5f - 0.5f * y, depth};
}

}  // namespace raylab
