#pragma once

#include <glm/glm.hpp>

#include "ui/editor/camera_control.h"
#include "ui/editor/context.h"

struct ImDrawList;

namespace raylab {

/// Draws lines of the scene over the viewport's picture, into the list of the window that is current when it is made.
class LinePainter {
public:
    explicit LinePainter(const EditorContext& context);

    /// `color` as ImGui has it; what lies behind the camera is cut off.
    void line(glm::vec3 a, glm::vec3 b, uint32_t color, float thickness) const;

private:
    float depth(const glm::vec3& point) const { return glm::dot(point - camera_.position, axes_.ahead); }
    glm::vec2 pixel(const glm::vec3& point) const;

    const Camera& camera_;
    const ViewRectangle& view_;
    CameraAxes axes_;
    float near_;
    ImDrawList& list_;
};

}  // namespace raylab
