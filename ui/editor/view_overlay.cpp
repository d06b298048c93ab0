#include "ui/editor/view_overlay.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/scene/bounds.h"
#include "ui/editor/evidence_view.h"
#include "ui/editor/line_painter.h"
#include "ui/editor/mesh_box.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

constexpr int kGridLines = 20;  ///< to each side

/// On the plane y = 0: lines a power of ten apart, as suits the distance of the pivot.
void drawGrid(const EditorContext& context, const LinePainter& painter) {
    const Camera& camera = context.state.camera;
    const float distance = glm::distance(camera.position, camera.target);
    const float step = std::pow(10.0f, std::floor(std::log10(std::max(distance * 0.3f, 1e-6f))));
    const float x0 = std::round(camera.target.x / step) * step, z0 = std::round(camera.target.z / step) * step;
    const float reach = step * kGridLines;
    for (int i = -kGridLines; i <= kGridLines; ++i) {
        const float offset = step * static_cast<float>(i);
        const auto shade = [&](float at) {
            const bool axis = std::abs(at) < 0.5f * step;
            const float fade = 1.0f - std::abs(static_cast<float>(i)) / (kGridLines + 1);
            return ImGui::GetColorU32(ImVec4(1.0f, 1.0f, 1.0f, (axis ? 0.45f : 0.16f) * fade));
        };
        painter.line({x0 + offset, 0.0f, z0 - reach}, {x0 + offset, 0.0f, z0 + reach}, shade(x0 + offset), 1.0f);
        painter.line({x0 - reach, 0.0f, z0 + offset}, {x0 + reach, 0.0f, z0 + offset}, shade(z0 + offset), 1.0f);
    }
}

void drawBox(const Bounds& box, const glm::mat4& toWorld, const LinePainter& painter, ImU32 color) {
    const auto corner = [&](int i) {
        const glm::vec3 p((i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y, (i & 4) != 0 ? box.hi.z : box.lo.z);
        return glm::vec3(toWorld * glm::vec4(p, 1.0f));
    };
    for (int i = 0; i < 8; ++i)
        for (const int bit : {1, 2, 4})
            if ((i & bit) == 0) painter.line(corner(i), corner(i | bit), color, 1.5f);
}

}  // namespace

void drawViewOverlay(EditorContext& context) {
    const EditorState& state = context.state;
    const LinePainter painter(context);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ViewRectangle& r = context.view;
    list.PushClipRect({r.x, r.y}, {r.x + r.width, r.y + r.height}, true);
    if (context.config.showGrid) drawGrid(context, painter);
    for (const uint32_t index : state.document->selection().instances) {
        const Instance& instance = state.scene().instances[index];
        drawBox(meshBox(state.scene(), instance.mesh), instance.objectToWorld, painter, ImGui::GetColorU32(color::kSelection));
    }
    drawEvidence(context, painter);
    list.PopClipRect();
}

}  // namespace raylab
