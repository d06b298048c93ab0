#pragma once

#include <array>
#include <glm/glm.hpp>

#include "engine/scene/bounds.h"
#include "ui/editor/context.h"

struct ImDrawList;

namespace raylab {

/// Draws lines of the scene over the viewport's picture, into the current ImGui window. What lies behind a plane just
/// before the camera is cut off there: beyond it a projection would turn over. Colours are ImGui's, thickness counts
/// in its units.
class LinePainter {
public:
    explicit LinePainter(const EditorContext& context);

    void line(const glm::vec3& a, const glm::vec3& b, uint32_t color, float thickness) const;
    /// Of a ray that begins at the camera, where a line would be a dot: a cross of so many units.
    void mark(const glm::vec3& at, uint32_t color, float size) const;
    void triangle(const std::array<glm::vec3, 3>& corners, uint32_t color, uint32_t fill, float thickness) const;
    /// The twelve edges of a box in a space of its own.
    void box(const Bounds& box, const glm::mat4& toWorld, uint32_t color, float thickness) const;

private:
    /// To the right, upwards and ahead of the camera.
    glm::vec3 inView(const glm::vec3& point) const;
    glm::vec2 pixel(const glm::vec3& view) const;
    void lineInView(glm::vec3 a, glm::vec3 b, uint32_t color, float thickness) const;

    glm::vec3 position_;
    glm::mat3 worldToView_;
    glm::vec2 middle_;
    float pixelsPerSlope_;  ///< of the picture's height
    float near_;
    ImDrawList& list_;
};

}  // namespace raylab
