#include "ui/editor/model/gizmo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace raylab::editor {
namespace {

constexpr double kWidth = 800.0, kHeight = 600.0;

GizmoView viewFrom(glm::vec3 position, glm::vec3 target = glm::vec3(0.0f)) {
    return GizmoView({.position = position, .target = target, .fovYRadians = 0.9f}, kWidth, kHeight);
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

void expectNear(const glm::dmat4& a, const glm::dmat4& b, double tolerance = 1e-9) {
    for (int c = 0; c < 4; ++c) EXPECT_LE(glm::length(a[c] - b[c]), tolerance) << "column " << c;
}

glm::dvec2 pixelOf(const GizmoView& view, const glm::dvec3& point) {
    const auto pixel = view.project(point);
    EXPECT_TRUE(pixel);
    return pixel.value_or(glm::dvec2(0.0));
}

glm::dvec3 apply(const glm::dmat4& map, const glm::dvec3& point) { return glm::dvec3(map * glm::dvec4(point, 1.0)); }

GizmoPose worldPose(const GizmoView& view, GizmoMode mode, const glm::dvec3& at) {
    return gizmoPose(view, mode, GizmoSpace::world, glm::translate(glm::mat4(1.0f), glm::vec3(at)));
}

TEST(GizmoView, ProjectsAsAPinholeDoes) {
    const GizmoView view = viewFrom({0, 0, 10});
    const double pixels = 0.5 * kHeight / std::tan(0.45) / 10.0;  // a world unit at distance 10
    const glm::dvec2 at = pixelOf(view, {1, 2, 0});
    EXPECT_NEAR(at.x, 400.0 + pixels, 1e-3);  // the field of view is a float
    EXPECT_NEAR(at.y, 300.0 - 2.0 * pixels, 1e-3);
    EXPECT_NEAR(view.worldPerPixel({0, 0, 0}), 1.0 / pixels, 1e-7);
    EXPECT_FALSE(view.project({0, 0, 11}));
    const ViewRay ray = view.ray(at);
    expectNear(ray.origin + ray.direction * glm::length(glm::dvec3(1, 2, -10)), {1, 2, 0}, 1e-9);
}

TEST(GizmoMove, APointOnAnArmFollowsThePointer) {
    const GizmoView view = viewFrom({4, 5, 9});
    const glm::dvec3 origin(0.5, -0.25, 1.0);
    const GizmoPose pose = worldPose(view, GizmoMode::move, origin);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 along(0.0);
        along[axis] = 1.0;
        const glm::dvec3 grabbed = origin + 0.4 * along;
        for (const double distance : {-2.0, -0.1, 0.0, 0.3, 3.0}) {
            GizmoDrag drag(view, GizmoMode::move, pose, static_cast<GizmoHandle>(axis), pixelOf(view, grabbed));
            const glm::dmat4 map = drag.at(pixelOf(view, grabbed + distance * along));
            expectNear(apply(map, origin), origin + distance * along);
            EXPECT_NEAR(drag.amount()[axis], distance, 1e-9);
        }
    }
}

TEST(GizmoMove, APointOfAPlaneFollowsThePointer) {
    const GizmoView view = viewFrom({4, 5, 9});
    const glm::dvec3 origin(0.5, -0.25, 1.0);
    const GizmoPose pose = worldPose(view, GizmoMode::move, origin);
    for (int normal = 0; normal < 3; ++normal) {
        glm::dvec3 way(0.7, -0.3, 0.45);
        way[normal] = 0.0;
        GizmoDrag drag(view, GizmoMode::move, pose, static_cast<GizmoHandle>(3 + normal), pixelOf(view, origin));
        expectNear(apply(drag.at(pixelOf(view, origin + way)), origin), origin + way);
    }
    GizmoDrag center(view, GizmoMode::move, pose, GizmoHandle::center, pixelOf(view, origin));
    const glm::dvec3 inImage = 0.6 * view.right() - 0.8 * view.up();
    expectNear(apply(center.at(pixelOf(view, origin + inImage)), origin), origin + inImage);
}

TEST(GizmoMove, LocalAxesAreThoseOfTheMatrix) {
    const GizmoView view = viewFrom({4, 5, 9});
    glm::mat4 matrix = glm::rotate(glm::mat4(1.0f), 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    matrix = glm::scale(matrix, glm::vec3(2, 3, 0.5f));
    const GizmoPose pose = gizmoPose(view, GizmoMode::move, GizmoSpace::local, matrix);
    const glm::dvec3 y = glm::normalize(glm::dvec3(matrix[1]));
    expectNear(pose.axes[1], y, 1e-6);
    GizmoDrag drag(view, GizmoMode::move, pose, GizmoHandle::y, pixelOf(view, 0.5 * y));
    expectNear(apply(drag.at(pixelOf(view, 1.25 * y)), {0, 0, 0}), 0.75 * y, 1e-5);
}

TEST(GizmoMove, SnapsToSteps) {
    const GizmoView view = viewFrom({4, 5, 9});
    const GizmoPose pose = worldPose(view, GizmoMode::move, {0, 0, 0});
    GizmoDrag drag(view, GizmoMode::move, pose, GizmoHandle::x, pixelOf(view, {0, 0, 0}));
    expectNear(apply(drag.at(pixelOf(view, {1.27, 0, 0}), {.move = 0.5}), {0, 0, 0}), {1.5, 0, 0});
    expectNear(apply(drag.at(pixelOf(view, {1.2, 0, 0}), {.move = 0.5}), {0, 0, 0}), {1.0, 0, 0});
    expectNear(apply(drag.at(pixelOf(view, {1.2, 0, 0}), {.move = 0.1}), {0, 0, 0}), {1.2, 0, 0});
    const double step = snapSteps(pose).move;
    EXPECT_GE(step, 12.0 * pose.worldPerPixel);
    EXPECT_LE(step, 60.0 * pose.worldPerPixel + 1e-12);
    const double digits = std::log10(step), fives = std::log10(step / 5.0);
    EXPECT_TRUE(std::abs(digits - std::round(digits)) < 1e-9 || std::abs(fives - std::round(fives)) < 1e-9) << step;
}

TEST(GizmoMove, AnArmTowardsTheEyeCannotBeGrabbedAndDoesNotFlyOff) {
    const GizmoView view = viewFrom({0, 0, 10});
    const GizmoPose pose = worldPose(view, GizmoMode::move, {0, 0, 0});
    for (const GizmoPart& part : gizmoParts(view, GizmoMode::move, pose)) {
        EXPECT_NE(part.handle, GizmoHandle::z);
        EXPECT_NE(part.handle, GizmoHandle::yz);  // seen from its edge
        EXPECT_NE(part.handle, GizmoHandle::zx);
    }
    GizmoDrag drag(view, GizmoMode::move, pose, GizmoHandle::z, {400.0, 300.0});
    const glm::dmat4 map = drag.at({400.0, 300.0});
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) EXPECT_TRUE(std::isfinite(map[c][r]));
    expectNear(map, glm::dmat4(1.0));
}

TEST(GizmoMove, BeyondTheHorizonTheLastPlaceHolds) {
    const GizmoView view = viewFrom({0, 1, 10}, {0, 1, 0});
    const GizmoPose pose = worldPose(view, GizmoMode::move, {0, 0, 0});
    GizmoDrag drag(view, GizmoMode::move, pose, GizmoHandle::zx, pixelOf(view, {0, 0, 0}));
    const glm::dmat4 far = drag.at(pixelOf(view, {3, 0, -90}));
    expectNear(apply(far, {0, 0, 0}), {3, 0, -90}, 1e-6);
    expectNear(drag.at({400.0, 100.0}), far);  // in the sky
}

TEST(GizmoRotate, APointOnARingFollowsThePointer) {
    const GizmoView view = viewFrom({4, 5, 9});
    const glm::dvec3 origin(0.5, -0.25, 1.0);
    const GizmoPose pose = worldPose(view, GizmoMode::rotate, origin);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 a(0.0), u(0.0);
        a[axis] = 1.0;
        u[(axis + 1) % 3] = pose.armLength;
        for (const double degrees : {-120.0, -15.0, 40.0, 175.0}) {
            const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), glm::radians(degrees), a);
            GizmoDrag drag(view, GizmoMode::rotate, pose, static_cast<GizmoHandle>(axis), pixelOf(view, origin + u));
            const glm::dmat4 map = drag.at(pixelOf(view, origin + glm::dvec3(turn * glm::dvec4(u, 0.0))));
            expectNear(map, glm::translate(glm::dmat4(1.0), origin) * turn * glm::translate(glm::dmat4(1.0), -origin),
                       1e-9);
        }
    }
}

TEST(GizmoRotate, GoesBeyondAFullTurnAndSnaps) {
    const GizmoView view = viewFrom({0, 8, 6});
    const GizmoPose pose = worldPose(view, GizmoMode::rotate, {0, 0, 0});
    const auto at = [&](double degrees) {
        return pixelOf(view, {std::cos(glm::radians(degrees)), 0.0, -std::sin(glm::radians(degrees))});
    };
    GizmoDrag drag(view, GizmoMode::rotate, pose, GizmoHandle::y, at(0.0));
    for (double degrees = 0.0; degrees <= 430.0; degrees += 10.0) drag.at(at(degrees));
    EXPECT_NEAR(drag.amount().x, 430.0, 1e-6);
    drag.at(at(436.0), {.degrees = 15.0});
    EXPECT_NEAR(drag.amount().x, 435.0, 1e-9);
    for (double degrees = 436.0; degrees >= -100.0; degrees -= 4.0) drag.at(at(degrees));
    EXPECT_NEAR(drag.amount().x, -100.0, 1e-6);
}

TEST(GizmoRotate, ARingFromItsEdgeTurnsWithThePointersWay) {
    const GizmoView view = viewFrom({0, 0, 10});
    const GizmoPose pose = worldPose(view, GizmoMode::rotate, {0, 0, 0});
    GizmoDrag drag(view, GizmoMode::rotate, pose, GizmoHandle::y, {400.0, 300.0});
    const glm::dmat4 map =
        drag.at({400.0 + kGizmoArmPixels * glm::half_pi<double>(), 300.0});  // to the right: the near side goes right
    expectNear(apply(map, {0, 0, 1}), {1, 0, 0}, 1e-6);
    GizmoDrag tilt(view, GizmoMode::rotate, pose, GizmoHandle::x, {400.0, 300.0});
    expectNear(apply(tilt.at({400.0, 300.0 + kGizmoArmPixels * glm::half_pi<double>()}), {0, 0, 1}), {0, -1, 0}, 1e-6);
}

TEST(GizmoRotate, TheOuterRingTurnsAboutTheAxisOfView) {
    const GizmoView view = viewFrom({0, 0, 10});
    const GizmoPose pose = worldPose(view, GizmoMode::rotate, {0, 0, 0});
    GizmoDrag drag(view, GizmoMode::rotate, pose, GizmoHandle::center, pixelOf(view, {1, 0, 0}));
    expectNear(apply(drag.at(pixelOf(view, {0, 1, 0})), {1, 0, 0}), {0, 1, 0}, 1e-9);
}

TEST(GizmoScale, AnArmScalesAlongTheLocalAxisAloneWithoutShear) {
    const GizmoView view = viewFrom({4, 5, 9});
    glm::mat4 matrix = glm::translate(glm::mat4(1.0f), glm::vec3(0.5f, 0.25f, 0.0f));
    matrix = glm::rotate(matrix, 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    matrix = glm::scale(matrix, glm::vec3(2, 3, 0.5f));
    const GizmoPose pose = gizmoPose(view, GizmoMode::scale, GizmoSpace::world, matrix);
    const glm::dvec3 grabbed = pose.origin + 0.4 * pose.axes[1];
    GizmoDrag drag(view, GizmoMode::scale, pose, GizmoHandle::y, pixelOf(view, grabbed));
    const glm::dmat4 scaled = drag.at(pixelOf(view, pose.origin + 1.0 * pose.axes[1])) * glm::dmat4(matrix);
    expectNear(scaled, glm::dmat4(matrix) * glm::scale(glm::dmat4(1.0), glm::dvec3(1, 2.5, 1)), 1e-5);
    drag.at(pixelOf(view, pose.origin + 0.93 * pose.axes[1]), {.factor = 0.1});
    EXPECT_NEAR(drag.amount().y, 2.3, 1e-9);
    EXPECT_GT(glm::determinant(drag.at(pixelOf(view, pose.origin - 2.0 * pose.axes[1]))),
              0.0);  // never turned inside out
}

TEST(GizmoScale, TheMiddleScalesAllAxesAlike) {
    const GizmoView view = viewFrom({0, 0, 10});
    const GizmoPose pose = gizmoPose(view, GizmoMode::scale, GizmoSpace::local, glm::mat4(1.0f));
    GizmoDrag drag(view, GizmoMode::scale, pose, GizmoHandle::center, {400.0, 300.0});
    const double way = kGizmoArmPixels * std::sqrt(0.5);  // an arm's length to the upper right doubles
    expectNear(drag.at({400.0 + way, 300.0 - way}), glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)), 1e-6);
}

TEST(GizmoHit, HandlesAreHitWhereTheyAreDrawn) {
    const GizmoView view = viewFrom({4, 5, 9});
    const GizmoPose pose = worldPose(view, GizmoMode::move, {0.5, 0, 0});
    const auto parts = gizmoParts(view, GizmoMode::move, pose);
    ASSERT_EQ(parts.size(), 7u);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(hitGizmo(parts, pixelOf(view, pose.origin + 0.9 * pose.armLength * pose.axes[axis])),
                  static_cast<GizmoHandle>(axis));
    for (int normal = 0; normal < 3; ++normal) {
        const glm::dvec3 middle = 0.48 * pose.armLength * (pose.axes[(normal + 1) % 3] + pose.axes[(normal + 2) % 3]);
        EXPECT_EQ(hitGizmo(parts, pixelOf(view, pose.origin + middle)), static_cast<GizmoHandle>(3 + normal));
    }
    EXPECT_EQ(hitGizmo(parts, pixelOf(view, pose.origin)), GizmoHandle::center);
    const glm::dvec2 tip = pixelOf(view, pose.origin + pose.armLength * pose.axes[1]);
    EXPECT_EQ(hitGizmo(parts, tip + glm::dvec2(0.0, -7.0)), GizmoHandle::y);
    EXPECT_FALSE(hitGizmo(parts, tip + glm::dvec2(0.0, -9.0)));
    const auto rings = gizmoParts(view, GizmoMode::rotate, pose);
    ASSERT_EQ(rings.size(), 4u);
    for (int axis = 0; axis < 3; ++axis) {  // the half of each ring that faces the eye
        const glm::dvec3 a = pose.axes[axis], toEye = glm::normalize(view.position() - pose.origin);
        const glm::dvec3 near = glm::normalize(toEye - a * glm::dot(a, toEye)) * pose.armLength;
        EXPECT_EQ(hitGizmo(rings, pixelOf(view, pose.origin + near)), static_cast<GizmoHandle>(axis));
    }
}

TEST(GizmoHit, SizeInPixelsIsTheSameAtEveryDistance) {
    for (const float distance : {0.5f, 10.0f, 5000.0f}) {
        const GizmoView view = viewFrom({0, 0, distance});
        const GizmoPose pose = worldPose(view, GizmoMode::move, {0, 0, 0});
        EXPECT_NEAR(pixelOf(view, pose.axes[0] * pose.armLength).x, 400.0 + kGizmoArmPixels, 1e-4) << distance;
    }
    EXPECT_TRUE(
        gizmoParts(viewFrom({0, 0, 1}), GizmoMode::move, worldPose(viewFrom({0, 0, 1}), GizmoMode::move, {0, 0, 5}))
            .empty());
}

}  // namespace
}  // namespace raylab::editor
