#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "ui/editor/model/gizmo_geometry.h"

namespace raylab::editor {
namespace {

constexpr double kLeastFactor = 0.01;  ///< of a scale: less makes a thing that can hardly be seen or scaled back

double snapped(double value, double step) { return step > 0.0 ? std::round(value / step) * step : value; }

bool isArm(GizmoHandle handle) { return handle <= GizmoHandle::z; }
bool isPlane(GizmoHandle handle) { return handle >= GizmoHandle::yz && handle <= GizmoHandle::xy; }
int axisOf(GizmoHandle handle) { return static_cast<int>(handle) % 3; }

/// `map` about the pose's origin, in its axes.
glm::dmat4 around(const GizmoPose& pose, const glm::dmat4& map) {
    const glm::dmat4 there = glm::translate(glm::dmat4(1.0), pose.origin) * glm::dmat4(pose.axes);
    const glm::dmat4 back = glm::dmat4(glm::transpose(pose.axes)) * glm::translate(glm::dmat4(1.0), -pose.origin);
    return there * map * back;
}

}  // namespace

GizmoDrag::GizmoDrag(const GizmoView& view, GizmoMode mode, const GizmoPose& pose, GizmoHandle handle,
                     const glm::dvec2& pixel)
    : view_(view), mode_(mode), pose_(pose), handle_(handle), startPixel_(pixel) {
    if (handle == GizmoHandle::center)
        axis_ = mode == GizmoMode::rotate ? glm::normalize(view.position() - pose.origin) : -view.forward();
    else
        axis_ = pose.axes[axisOf(handle)];
    lastAngle_ = mode == GizmoMode::rotate ? angleAt(pixel).value_or(0.0) : 0.0;
    if (mode == GizmoMode::scale) amount_ = glm::dvec3(1.0);
}

const glm::dmat4& GizmoDrag::at(const glm::dvec2& pixel, const GizmoSnap& snap) {
    switch (mode_) {
        case GizmoMode::move:
            map_ = moved(pixel, snap);
            break;
        case GizmoMode::rotate:
            map_ = turned(pixel, snap);
            break;
        case GizmoMode::scale:
            map_ = scaled(pixel, snap);
            break;
    }
    return map_;
}

/// The point of the handle's line or plane under the pointer travels with it.
glm::dmat4 GizmoDrag::moved(const glm::dvec2& pixel, const GizmoSnap& snap) {
    glm::dvec3 amount(0.0);  // along the pose's axes
    if (isArm(handle_)) {
        const auto from = nearestOnLine(view_.ray(startPixel_), pose_.origin, axis_);
        const auto to = nearestOnLine(view_.ray(pixel), pose_.origin, axis_);
        if (!from || !to) return map_;
        amount[axisOf(handle_)] = *to - *from;
    } else {
        const auto from = hitPlane(view_.ray(startPixel_), pose_.origin, axis_);
        const auto to = hitPlane(view_.ray(pixel), pose_.origin, axis_);
        if (!from || !to) return map_;
        amount = glm::transpose(pose_.axes) * (*to - *from);
        if (isPlane(handle_)) amount[axisOf(handle_)] = 0.0;
    }
    for (int c = 0; c < 3; ++c) amount[c] = snapped(amount[c], snap.move);
    amount_ = amount;
    return glm::translate(glm::dmat4(1.0), pose_.axes * amount);
}

/// Radians in the ring's plane, from where the pointer's ray meets it; a ring that is seen from its edge has the
/// pointer's way along its tangent in the image, an arm's length a radian.
std::optional<double> GizmoDrag::angleAt(const glm::dvec2& pixel) const {
    if (!isPlaneVisible(view_, pose_, axis_)) {
        const glm::dvec3 toEye = glm::normalize(view_.position() - pose_.origin);
        const glm::dvec3 tangent = glm::cross(axis_, toEye);  // of the ring at its point nearest to the eye
        const glm::dvec2 inImage(glm::dot(tangent, view_.right()), -glm::dot(tangent, view_.up()));
        return glm::dot(pixel - startPixel_, inImage) * pose_.worldPerPixel / pose_.armLength;
    }
    const auto point = hitPlane(view_.ray(pixel), pose_.origin, axis_);
    if (!point) return std::nullopt;
    const glm::dvec3 u = glm::normalize(std::abs(axis_.y) < 0.9 ? glm::cross(axis_, glm::dvec3(0, 1, 0))
                                                                : glm::cross(axis_, glm::dvec3(1, 0, 0)));
    const glm::dvec3 radius = *point - pose_.origin;
    return std::atan2(glm::dot(radius, glm::cross(axis_, u)), glm::dot(radius, u));
}

/// The angle is followed from one pointer to the next, so that it goes beyond a full turn.
glm::dmat4 GizmoDrag::turned(const glm::dvec2& pixel, const GizmoSnap& snap) {
    const std::optional<double> angle = angleAt(pixel);
    if (!angle) return map_;
    turnedBy_ += isPlaneVisible(view_, pose_, axis_) ? std::remainder(*angle - lastAngle_, glm::two_pi<double>())
                                                     : *angle - lastAngle_;
    lastAngle_ = *angle;
    const double degrees = snapped(glm::degrees(turnedBy_), snap.degrees);
    amount_ = {degrees, 0.0, 0.0};
    return glm::translate(glm::dmat4(1.0), pose_.origin) * glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis_) *
           glm::translate(glm::dmat4(1.0), -pose_.origin);
}

/// An arm by how far along it the pointer is, against where it began; the others by the pointer's way to the upper
/// right, an arm's length for each factor of one.
glm::dmat4 GizmoDrag::scaled(const glm::dvec2& pixel, const GizmoSnap& snap) {
    double factor = 1.0;
    if (isArm(handle_)) {
        const auto from = nearestOnLine(view_.ray(startPixel_), pose_.origin, axis_);
        const auto to = nearestOnLine(view_.ray(pixel), pose_.origin, axis_);
        if (!from || !to || std::abs(*from) < pose_.worldPerPixel) return map_;
        factor = *to / *from;
    } else {
        const glm::dvec2 way = pixel - startPixel_;
        factor = 1.0 + (way.x - way.y) * std::sqrt(0.5) * pose_.worldPerPixel / pose_.armLength;
    }
    factor = std::max(snapped(factor, snap.factor), std::max(kLeastFactor, snap.factor));
    amount_ = glm::dvec3(factor);
    if (isArm(handle_)) amount_ = glm::dvec3(1.0), amount_[axisOf(handle_)] = factor;
    if (isPlane(handle_)) amount_[axisOf(handle_)] = 1.0;
    return around(pose_, glm::scale(glm::dmat4(1.0), amount_));
}

}  // namespace raylab::editor
