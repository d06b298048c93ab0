#include <imgui.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "ui/editor/model/edit_cameras.h"
#include "ui/editor/model/edit_surroundings.h"
#include "ui/editor/panels/inspector.h"
#include "ui/editor/theme.h"
#include "ui/editor/view_actions.h"

namespace raylab {
namespace {

struct RadiusStep {
    float length = 0.5f;  ///< scene units
};

/// Position, target, radius with its step, and field of view. Returns what was changed; nullptr: nothing.
const char* drawCameraFields(EditorContext& context, Camera& camera) {
    float& step = context.states.get<RadiusStep>().length;
    const Camera before = camera;
    const char* changed = nullptr;
    if (ImGui::DragFloat3("position", &camera.position.x, 0.01f)) changed = "position";
    if (ImGui::DragFloat3("target", &camera.target.x, 0.01f)) changed = "target";
    float radius = editor::cameraRadius(camera);
    if (ImGui::DragFloat("radius", &radius, 0.01f * radius, 1e-3f, 1e9f, "%.3f")) {
        camera = editor::atRadius(camera, std::max(radius, 1e-3f));
        changed = "radius";
    }
    inspectorTip("Distance from the target, along the line of view");
    ImGui::SetNextItemWidth(ImGui::CalcItemWidth() -
                            2.0f * (ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x));
    ImGui::InputFloat("##step", &step, 0.0f, 0.0f, "%.3f");
    inspectorTip("Length of a step of the radius");
    for (const int way : {-1, 1}) {
        ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
        if (ImGui::Button(way < 0 ? "-" : "+", {ImGui::GetFrameHeight(), 0.0f})) {
            camera = editor::movedAlongView(camera, std::max(step, 0.0f), way);
            changed = "radius";
        }
    }
    ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::TextUnformatted("step");
    float degrees = glm::degrees(camera.fovYRadians);
    if (ImGui::SliderFloat("field of view", &degrees, 1.0f, 150.0f, "%.1f deg")) {
        camera.fovYRadians = glm::radians(std::clamp(degrees, 1.0f, 150.0f));
        changed = "field of view";
    }
    if (camera.position == camera.target) camera = before;
    return changed;
}

void drawLens(EditorContext& context) {
    const RenderSettings& settings = context.state.settings();
    float radius = static_cast<float>(settings.lensRadius), focus = static_cast<float>(settings.focusDistance);
    if (ImGui::DragFloat("lens radius", &radius, 0.002f, 0.0f, 1e3f, radius > 0.0f ? "%.3f" : "pinhole"))
        tryEdit(context, [&] {
            return editor::setRenderSetting("lens-radius", std::to_string(std::max(radius, 0.0f)), "lens");
        });
    inspectorTip("Focal length over twice the f-number; 0: a pinhole, all is sharp");
    if (ImGui::DragFloat("focus", &focus, 0.02f, 0.0f, 1e6f, focus > 0.0f ? "%.3f" : "at the target"))
        tryEdit(context, [&] {
            return editor::setRenderSetting("focus-distance", std::to_string(std::max(focus, 0.0f)), "focus");
        });
    inspectorTip("Distance that is sharp; 0: that of the target, which a double click in the viewport sets");
}

}  // namespace

void inspectCamera(EditorContext& context, uint32_t index) {
    Camera camera = context.state.scene().cameras[index];
    if (editName(camera.name)) applyEdit(context, editor::setCamera(index, camera, "name"));
    if (const char* what = drawCameraFields(context, camera))
        applyEdit(context,
                  editor::setCamera(index, camera, what, std::string(what) + " of camera " + std::to_string(index)));
    ImGui::Spacing();
    if (ImGui::Button("Look through it")) context.state.camera = context.state.scene().cameras[index];
    ImGui::SameLine();
    if (ImGui::Button("Set to view")) {
        Camera here = context.state.camera;
        here.name = camera.name;
        applyEdit(context, editor::setCamera(index, here, "view"));
    }
    inspectorTip("It stands where you are");
    if (ImGui::Button("Delete")) applyEdit(context, editor::deleteCamera(index));
}

void inspectView(EditorContext& context) {
    inspectorHeading("View");
    drawCameraFields(context, context.state.camera);
    drawLens(context);
    if (ImGui::Button("Save view")) saveView(context);
    inspectorTip("As a camera of the scene");
    ImGui::SameLine();
    if (ImGui::Button("Copy")) ImGui::SetClipboardText(editor::cameraText(context.state.camera).c_str());
    ImGui::SameLine();
    if (ImGui::Button("Paste")) {
        const char* text = ImGui::GetClipboardText();
        try {
            context.state.camera = editor::parseCamera(text == nullptr ? "" : text);
        } catch (const Error& error) {
            logError(error.what());
        }
    }
}

}  // namespace raylab
