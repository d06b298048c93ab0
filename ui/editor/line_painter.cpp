#include "ui/editor/line_painter.h"

#include <imgui.h>

#include <cmath>

#include "ui/editor/camera_control.h"

namespace raylab {
namespace {

constexpr float kNear = 1e-3f;  ///< of the distance to the target: lines are cut there

}  // namespace

LinePainter::LinePainter(const EditorContext& context)
    : position_(context.state.camera.position),
      middle_(context.view.x + 0.5f * context.view.width, context.view.y + 0.5f * context.view.height),
      pixelsPerSlope_(0.5f * context.view.height / std::tan(0.5f * context.state.camera.fovYRadians)),
      near_(kNear * glm::distance(position_, context.state.camera.target)),
      list_(*ImGui::GetWindowDrawList()) {
    const CameraAxes axes = cameraAxes(context.state.camera);
    worldToView_ = glm::transpose(glm::mat3(axes.right, axes.up, axes.ahead));
}

glm::vec3 LinePainter::inView(const glm::vec3& point) const { return worldToView_ * (point - position_); }

glm::vec2 LinePainter::pixel(const glm::vec3& view) const {
    const float scale = pixelsPerSlope_ / view.z;
    return {middle_.x + scale * view.x, middle_.y - scale * view.y};
}

void LinePainter::lineInView(glm::vec3 a, glm::vec3 b, uint32_t color, float thickness) const {
    if (a.z < near_ && b.z < near_) return;
    if (a.z < near_) a = glm::mix(a, b, (near_ - a.z) / (b.z - a.z));
    if (b.z < near_) b = glm::mix(b, a, (near_ - b.z) / (a.z - b.z));
    const glm::vec2 from = pixel(a), to = pixel(b);
    list_.AddLine({from.x, from.y}, {to.x, to.y}, color, thickness);
}

void LinePainter::line(const glm::vec3& a, const glm::vec3& b, uint32_t color, float thickness) const {
    lineInView(inView(a), inView(b), color, thickness);
}

void LinePainter::mark(const glm::vec3& at, uint32_t color, float size) const {
    const glm::vec3 view = inView(at);
    if (view.z < near_) return;
    const glm::vec2 p = pixel(view);
    list_.AddLine({p.x - size, p.y}, {p.x + size, p.y}, color, 2.0f);
    list_.AddLine({p.x, p.y - size}, {p.x, p.y + size}, color, 2.0f);
}

void LinePainter::triangle(const std::array<glm::vec3, 3>& corners, uint32_t color, uint32_t fill,
                           float thickness) const {
    const std::array view{inView(corners[0]), inView(corners[1]), inView(corners[2])};
    if (view[0].z >= near_ && view[1].z >= near_ && view[2].z >= near_) {
        const std::array at{pixel(view[0]), pixel(view[1]), pixel(view[2])};
        list_.AddTriangleFilled({at[0].x, at[0].y}, {at[1].x, at[1].y}, {at[2].x, at[2].y}, fill);
    }
    for (size_t i = 0; i < 3; ++i) lineInView(view[i], view[(i + 1) % 3], color, thickness);
}

void LinePainter::box(const Bounds& box, const glm::mat4& toWorld, uint32_t color, float thickness) const {
    std::array<glm::vec3, 8> corners;
    for (size_t i = 0; i < 8; ++i) {
        const glm::vec3 p((i & 1u) != 0 ? box.hi.x : box.lo.x, (i & 2u) != 0 ? box.hi.y : box.lo.y,
                          (i & 4u) != 0 ? box.hi.z : box.lo.z);
        corners[i] = inView(glm::vec3(toWorld * glm::vec4(p, 1.0f)));
    }
    for (size_t i = 0; i < 8; ++i)
        for (const size_t bit : {1u, 2u, 4u})
            if ((i & bit) == 0) lineInView(corners[i], corners[i | bit], color, thickness);
}

}  // namespace raylab
