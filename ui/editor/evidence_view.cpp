#include "ui/editor/evidence_view.h"

#include <imgui.h>

#include <algorithm>

#include "engine/core/log.h"
#include "engine/render/camera.h"
#include "engine/scene/bounds.h"
#include "ui/editor/line_painter.h"
#include "ui/editor/places.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

constexpr size_t kMostRays = 400;
constexpr float kRayShare = 0.35f;     ///< of the scene's diagonal: how far a ray is drawn
constexpr int64_t kLeastSamples = 64;  ///< of the viewport's picture

struct EvidenceState {
    stability::Evidence evidence;
    Camera camera;
    float diagonal = 1.0f;
    const editor::Document* document = nullptr;  ///< that holds its scene
};

void drawRays(const EvidenceState& state, const LinePainter& painter) {
    const ImU32 red = ImGui::GetColorU32(ImVec4(1.0f, 0.35f, 0.3f, 0.55f));
    const ImU32 start = ImGui::GetColorU32(color::kSelection);
    const size_t step = std::max<size_t>(state.evidence.rays.size() / kMostRays, 1);
    for (size_t i = 0; i < state.evidence.rays.size(); i += step) {
        const shared::RayData& ray = state.evidence.rays[i];
        const glm::vec3 way = kRayShare * state.diagonal * glm::normalize(ray.direction);
        painter.line(ray.origin, ray.origin + way, red, 1.2f);
        painter.line(ray.origin, ray.origin + 0.04f * way, start, 3.0f);
    }
}

void drawPixels(const EditorContext& context, const EvidenceState& state) {
    const ViewRectangle& r = context.view;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 red = ImGui::GetColorU32(ImVec4(1.0f, 0.3f, 0.25f, 0.9f));
    const float cellX = 0.5f * r.width / static_cast<float>(state.evidence.settings.width);
    const float cellY = 0.5f * r.height / static_cast<float>(state.evidence.settings.height);
    for (const glm::dvec2& pixel : state.evidence.pixels) {
        const float x = r.x + static_cast<float>(pixel.x) * r.width, y = r.y + static_cast<float>(pixel.y) * r.height;
        list.AddRect({x - cellX, y - cellY}, {x + cellX, y + cellY}, red);
    }
}

}  // namespace

void showEvidence(EditorContext& context, const std::string& title, const stability::Evidence& evidence) {
    RenderSettings settings = evidence.settings;
    settings.device = context.state.settings().device;
    settings.validation = context.state.settings().validation;
    settings.spp = std::max(settings.spp, kLeastSamples);
    editor::OpenedDocument opened{editor::Document(*evidence.scene, {}, settings), std::nullopt, {}};
    context.show(std::move(opened), [&context, title, evidence] {
        const Bounds box = sceneBounds(*evidence.scene);
        context.states.get<EvidenceState>() = {evidence, context.state.camera, glm::length(box.hi - box.lo),
                                               context.state.document.get()};
        logInfo("showing " + title);
    });
}

bool isShowingEvidence(EditorContext& context) {
    const EvidenceState& state = context.states.get<EvidenceState>();
    return state.document != nullptr && state.document == context.state.document.get();
}

void drawEvidence(EditorContext& context, const LinePainter& painter) {
    if (!isShowingEvidence(context)) return;
    const EvidenceState& state = context.states.get<EvidenceState>();
    noteValue(context, "evidence-rays", static_cast<double>(state.evidence.rays.size()));
    noteValue(context, "evidence-pixels", static_cast<double>(state.evidence.pixels.size()));
    drawRays(state, painter);
    if (context.state.camera == state.camera) drawPixels(context, state);
}

}  // namespace raylab
