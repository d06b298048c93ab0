#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ui/editor/model/gizmo_view.h"

namespace raylab::editor {

enum class GizmoMode { move, rotate, scale };
enum class GizmoSpace { world, local };

/// x, y, z: an arm or a ring; yz, zx, xy: the square of a plane; center: in the plane of the image (move), about the
/// axis of view (rotate), all axes alike (scale).
enum class GizmoHandle { x, y, z, yz, zx, xy, center };

/// Where a gizmo stands, and how large: its arms have the same length in pixels at every distance.
struct GizmoPose {
    glm::dvec3 origin{0.0};
    glm::dmat3 axes{1.0};  ///< unit, orthogonal columns
    double armLength = 1.0;
    double worldPerPixel = 1.0;  ///< at the origin
};

inline constexpr double kGizmoArmPixels = 90.0;
inline constexpr double kGizmoReachPixels = 8.0;  ///< within which a handle is hit

/// At the origin of the matrix. Scaling is along local axes in either space: along others it would shear.
GizmoPose gizmoPose(const GizmoView& view, GizmoMode mode, GizmoSpace space, const glm::mat4& objectToWorld,
                    double armPixels = kGizmoArmPixels);

/// A handle as one draws it and as it is hit: a polyline in pixels, closed and filled where it is an area.
struct GizmoPart {
    GizmoHandle handle = GizmoHandle::center;
    std::vector<glm::dvec2> pixels;
    bool isArea = false;
};

/// The parts of a gizmo, the ones to be drawn last at the end. An arm that points at the eye and a plane that is seen
/// from its edge are left out: they could not be dragged. Empty where the origin is behind the camera.
std::vector<GizmoPart> gizmoParts(const GizmoView& view, GizmoMode mode, const GizmoPose& pose);

/// The handle at a pixel: areas that contain it, or else the nearest line within `reachPixels`; of several areas the
/// last one.
std::optional<GizmoHandle> hitGizmo(std::span<const GizmoPart> parts, const glm::dvec2& pixel,
                                    double reachPixels = kGizmoReachPixels);

/// Steps that a drag keeps to; 0: any.
struct GizmoSnap {
    double move = 0.0;  ///< world units along each axis
    double degrees = 0.0;
    double factor = 0.0;  ///< of a scale
};

/// While the snapping key is down: 15 degrees, a tenth of the size, and the round length (1, 5 times a power of ten)
/// that is at least 12 pixels long.
GizmoSnap snapSteps(const GizmoPose& pose);

/// One drag of a handle. What it has done so far is an affine map in world space, to be multiplied from the left to the
/// matrices that the drag began with.
class GizmoDrag {
public:
    GizmoDrag(const GizmoView& view, GizmoMode mode, const GizmoPose& pose, GizmoHandle handle,
              const glm::dvec2& pixel);

    /// With the pointer at a pixel. Where the handle's line or plane has no point there (beyond the horizon), the last
    /// map holds.
    const glm::dmat4& at(const glm::dvec2& pixel, const GizmoSnap& snap = {});

    GizmoHandle handle() const { return handle_; }
    /// What to show beside the pointer: metres along the axes, degrees, or factors.
    const glm::dvec3& amount() const { return amount_; }

private:
    glm::dmat4 moved(const glm::dvec2& pixel, const GizmoSnap& snap);
    glm::dmat4 turned(const glm::dvec2& pixel, const GizmoSnap& snap);
    glm::dmat4 scaled(const glm::dvec2& pixel, const GizmoSnap& snap);
    std::optional<double> angleAt(const glm::dvec2& pixel) const;

    GizmoView view_;
    GizmoMode mode_;
    GizmoPose pose_;
    GizmoHandle handle_;
    glm::dvec2 startPixel_;
    glm::dvec3 axis_{0.0};  ///< of an arm or ring; the normal of a plane
    double lastAngle_ = 0.0;
    double turnedBy_ = 0.0;  ///< radians, beyond a full turn too
    glm::dvec3 amount_{0.0};
    glm::dmat4 map_{1.0};
};

}  // namespace raylab::editor
