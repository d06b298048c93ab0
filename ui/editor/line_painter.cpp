#include "ui/editor/line_painter.h"

#include <imgui.h>

namespace raylab {
namespace {

constexpr float kNear = 1e-3f;  ///< of the distance to the target: lines are cut there

}  // namespace

LinePainter::LinePainter(const EditorContext& context)
    : camera_(context.state.camera),
      view_(context.view),
      axes_(cameraAxes(camera_)),
      near_(kNear * glm::distance(camera_.position, camera_.target)),
      list_(*ImGui::GetWindowDrawList()) {}

void LinePainter::line(glm::vec3 a, glm::vec3 b, uint32_t color, float thickness) const {
    const float depthA = depth(a), depthB = depth(b);
    if (depthA < near_ && depthB < near_) return;
    if (depthA < near_) a = glm::mix(a, b, (near_ - depthA) / (depthB - depthA));
    if (depthB < near_) b = glm::mix(b, a, (near_ - depthB) / (depthA - depthB));
    const glm::vec2 from = pixel(a), to = pixel(b);
    list_.AddLine({from.x, from.y}, {to.x, to.y}, color, thickness);
}

glm::vec2 LinePainter::pixel(const glm::vec3& point) const {
    const glm::vec3 at = projectPoint(camera_, view_.aspect(), point);
    return {view_.x + at.x * view_.width, view_.y + at.y * view_.height};
}

}  // namespace raylab
