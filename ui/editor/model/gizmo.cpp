#include "ui/editor/model/gizmo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "ui/editor/model/gizmo_geometry.h"

namespace raylab::editor {
namespace {

constexpr double kPlaneFrom = 0.35, kPlaneTo = 0.6;  ///< of the arm: the corners of the squares
constexpr double kCenterPixels = 9.0;                ///< half the side of the square in the middle
constexpr double kViewRingScale = 1.2;               ///< of the ring about the axis of view
constexpr int kRingPoints = 64;

std::vector<glm::dvec2> projected(const GizmoView& view, std::span<const glm::dvec3> points) {
    std::vector<glm::dvec2> pixels;
    for (const glm::dvec3& point : points)
        if (const auto pixel = view.project(point)) pixels.push_back(*pixel);
    return pixels;
}

void addPart(const GizmoView& view, GizmoHandle handle, std::span<const glm::dvec3> points, bool isArea,
             std::vector<GizmoPart>& parts) {
    GizmoPart part{handle, projected(view, points), isArea};
    if (part.pixels.size() == points.size()) parts.push_back(std::move(part));
}

void addArm(const GizmoView& view, const GizmoPose& pose, int axis, std::vector<GizmoPart>& parts) {
    const glm::dvec3 tip = pose.origin + pose.axes[axis] * pose.armLength;
    const std::array line = {pose.origin + pose.axes[axis] * (0.15 * pose.armLength), tip};
    if (isArmVisible(view, pose, axis)) addPart(view, static_cast<GizmoHandle>(axis), line, false, parts);
}

void addPlane(const GizmoView& view, const GizmoPose& pose, int normal, std::vector<GizmoPart>& parts) {
    if (!isPlaneVisible(view, pose, pose.axes[normal])) return;
    const glm::dvec3 u = pose.axes[(normal + 1) % 3] * pose.armLength, v = pose.axes[(normal + 2) % 3] * pose.armLength;
    const std::array corners = {pose.origin + u * kPlaneFrom + v * kPlaneFrom,
                                pose.origin + u * kPlaneTo + v * kPlaneFrom, pose.origin + u * kPlaneTo + v * kPlaneTo,
                                pose.origin + u * kPlaneFrom + v * kPlaneTo};
    addPart(view, static_cast<GizmoHandle>(3 + normal), corners, true, parts);
}

/// Of a ring about a unit axis, the half that faces the eye; all of it where `isWhole`.
void addRing(const GizmoView& view, const GizmoPose& pose, GizmoHandle handle, const glm::dvec3& axis, double radius,
             bool isWhole, std::vector<GizmoPart>& parts) {
    const glm::dvec3 toEye = glm::normalize(view.position() - pose.origin);
    glm::dvec3 u = glm::cross(axis, toEye);
    if (glm::length(u) < 1e-3) u = glm::cross(axis, view.up());
    if (glm::length(u) < 1e-3) u = glm::cross(axis, view.right());
    u = glm::normalize(u);
    const glm::dvec3 towardsEye = glm::cross(u, axis);  // the half circle from u over it to -u is the near one
    const double span = isWhole ? glm::two_pi<double>() : glm::pi<double>();
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= kRingPoints; ++i) {
        const double angle = span * i / kRingPoints;
        points.push_back(pose.origin + (u * std::cos(angle) + towardsEye * std::sin(angle)) * radius);
    }
    addPart(view, handle, points, false, parts);
}

void addCenter(const GizmoView& view, const GizmoPose& pose, std::vector<GizmoPart>& parts) {
    const double half = kCenterPixels * pose.worldPerPixel;
    const glm::dvec3 u = view.right() * half, v = view.up() * half;
    addPart(view, GizmoHandle::center,
            std::array{pose.origin - u - v, pose.origin + u - v, pose.origin + u + v, pose.origin - u + v}, true,
            parts);
}

double distanceToSegment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double squared = glm::dot(along, along);
    const double t = squared > 0.0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + along * t);
}

double distanceToLine(const glm::dvec2& p, std::span<const glm::dvec2> line) {
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i + 1 < line.size(); ++i)
        nearest = std::min(nearest, distanceToSegment(p, line[i], line[i + 1]));
    return nearest;
}

/// By the number of edges to the right of the point.
bool contains(std::span<const glm::dvec2> area, const glm::dvec2& p) {
    bool inside = false;
    for (size_t i = 0, j = area.size() - 1; i < area.size(); j = i++) {
        const glm::dvec2 a = area[i], b = area[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
    }
    return inside;
}

}  // namespace

GizmoPose gizmoPose(const GizmoView& view, GizmoMode mode, GizmoSpace space, const glm::mat4& objectToWorld,
                    double armPixels) {
    GizmoPose pose;
    pose.origin = glm::dvec3(objectToWorld[3]);
    pose.worldPerPixel = view.worldPerPixel(pose.origin);
    pose.armLength = armPixels * pose.worldPerPixel;
    if (space == GizmoSpace::world && mode != GizmoMode::scale) return pose;
    const glm::dmat3 m(objectToWorld);  // by Gram and Schmidt: a sheared matrix has no orthogonal axes of its own
    pose.axes[0] = glm::normalize(m[0]);
    pose.axes[1] = glm::normalize(m[1] - pose.axes[0] * glm::dot(pose.axes[0], m[1]));
    pose.axes[2] = glm::cross(pose.axes[0], pose.axes[1]);
    return pose;
}

std::vector<GizmoPart> gizmoParts(const GizmoView& view, GizmoMode mode, const GizmoPose& pose) {
    std::vector<GizmoPart> parts;
    if (!view.project(pose.origin)) return parts;
    if (mode == GizmoMode::rotate) {
        const glm::dvec3 toEye = glm::normalize(view.position() - pose.origin);
        addRing(view, pose, GizmoHandle::center, toEye, kViewRingScale * pose.armLength, true, parts);
        for (int axis = 0; axis < 3; ++axis)
            addRing(view, pose, static_cast<GizmoHandle>(axis), pose.axes[axis], pose.armLength, false, parts);
        return parts;
    }
    for (int axis = 0; axis < 3; ++axis) addArm(view, pose, axis, parts);
    for (int normal = 0; normal < 3; ++normal) addPlane(view, pose, normal, parts);
    addCenter(view, pose, parts);
    return parts;
}

std::optional<GizmoHandle> hitGizmo(std::span<const GizmoPart> parts, const glm::dvec2& pixel, double reachPixels) {
    for (size_t i = parts.size(); i-- > 0;)
        if (parts[i].isArea && contains(parts[i].pixels, pixel)) return parts[i].handle;
    std::optional<GizmoHandle> hit;
    double nearest = reachPixels;
    for (const GizmoPart& part : parts) {
        if (part.isArea) continue;
        const double distance = distanceToLine(pixel, part.pixels);
        if (distance > nearest) continue;
        nearest = distance;
        hit = part.handle;
    }
    return hit;
}

GizmoSnap snapSteps(const GizmoPose& pose) {
    constexpr double kLeastPixels = 12.0;
    const double least = kLeastPixels * pose.worldPerPixel;
    const double decade = std::pow(10.0, std::floor(std::log10(least)));
    const double step = least <= decade ? decade : least <= 5.0 * decade ? 5.0 * decade : 10.0 * decade;
    return {.move = step, .degrees = 15.0, .factor = 0.1};
}

}  // namespace raylab::editor
