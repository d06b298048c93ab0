#include <imgui.h>

#include "ui/editor/model/edit_surroundings.h"
#include "ui/editor/panels/inspector.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

void drawSky(EditorContext& context) {
    SkyDescription sky = *context.state.scene().sky;
    float elevation = glm::degrees(sky.sunElevationRadians), azimuth = glm::degrees(sky.sunAzimuthRadians);
    bool changed = ImGui::SliderFloat("elevation", &elevation, -10.0f, 90.0f, "%.1f deg");
    inspectorTip("Of the sun above the horizon");
    changed |= ImGui::SliderFloat("azimuth", &azimuth, 0.0f, 360.0f, "%.1f deg");
    inspectorTip("0 at -Z, growing towards +X");
    changed |= ImGui::SliderFloat("turbidity", &sky.turbidity, 1.0f, 10.0f, "%.2f");
    inspectorTip("1: pure air; 10: haze");
    changed |= ImGui::DragFloat("brightness", &sky.scale, 0.01f, 0.0f, 1e6f, "%.3f");
    if (!changed) return;
    sky.sunElevationRadians = glm::radians(elevation);
    sky.sunAzimuthRadians = glm::radians(azimuth);
    applyEdit(context, editor::setSky(sky, "sky"));
}

}  // namespace

void inspectSurroundings(EditorContext& context) {
    inspectorHeading("Surroundings");
    const Scene& scene = context.state.scene();
    if (scene.sky)
        drawSky(context);
    else if (scene.environment)
        ImGui::Text("a radiance map, %d x %d", scene.environment->radiance.width, scene.environment->radiance.height);
    else
        ImGui::TextWrapped("Neither sky nor radiance map in the scene (a scene without any light gets a sky).");
    if (!context.state.scene().sky && ImGui::Button("Sky")) applyEdit(context, editor::setSky(SkyDescription{}));
    if (!context.state.scene().sky) ImGui::SameLine();
    if (ImGui::Button("Map...")) context.fileDialog.open(OpenMode::environment);
    inspectorTip("A latitude-longitude image; or drop an HDR or EXR file on the window");
    if (!context.state.scene().sky && !context.state.scene().environment) return;
    ImGui::SameLine();
    if (ImGui::Button("None")) applyEdit(context, editor::removeSurroundings());
}

}  // namespace raylab
