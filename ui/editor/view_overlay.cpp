#include "ui/editor/view_overlay.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "ui/editor/evidence_view.h"
#include "ui/editor/line_painter.h"
#include "ui/editor/mesh_box.h"
#include "ui/editor/outline.h"
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

}  // namespace

void drawViewOverlay(EditorContext& context) {
    const EditorState& state = context.state;
    const LinePainter painter(context);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ViewRectangle& r = context.view;
    list.PushClipRect({r.x, r.y}, {r.x + r.width, r.y + r.height}, true);
    if (context.config.showGrid) drawGrid(context, painter);
    const bool hasOutline = !state.document->selection().instances.empty() && drawOutline(context);
    for (const uint32_t index : state.document->selection().instances) {
        if (hasOutline) break;
        const Instance& instance = state.scene().instances[index];
        painter.box(meshBox(state.scene(), instance.mesh), instance.objectToWorld, ImGui::GetColorU32(color::kSelection),
                    1.5f);
    }
    drawEvidence(context, painter);
    list.PopClipRect();
}

}  // namespace raylab
