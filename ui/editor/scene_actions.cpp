#include "ui/editor/scene_actions.h"

#include <imgui.h>

#include <algorithm>
#include <numeric>

#include "ui/editor/model/edit_cameras.h"
#include "ui/editor/model/edit_instances.h"
#include "ui/editor/model/edit_lights.h"
#include "ui/editor/model/edit_materials.h"
#include "ui/editor/model/shapes.h"

namespace raylab {
namespace {

constexpr float kNewShare = 0.08f;  ///< radius of what is added, of the distance to the pivot

const editor::Selection& selectionOf(const EditorContext& context) { return context.state.document->selection(); }

/// Bright enough to be seen next to a surface of the view's size.
Light newLight(const EditorContext& context, LightKind kind) {
    const Camera& camera = context.state.camera;
    const float distance = editor::cameraRadius(camera);
    Light light{.name = editor::lightKindName(kind), .kind = kind};
    light.position = camera.target + glm::vec3(0.0f, 0.25f * distance, 0.0f);
    light.intensity = glm::vec3(kind == LightKind::directional ? 3.0f : 0.5f * distance * distance);
    light.innerConeRadians = 0.5f * light.outerConeRadians;
    light.radius = 0.05f * distance;
    light.size = glm::vec2(0.1f * distance);
    return light;
}

void drawAddLights(EditorContext& context) {
    for (const LightKind kind : {LightKind::point, LightKind::directional, LightKind::spot, LightKind::sphere,
                                 LightKind::disc, LightKind::rectangle})
        if (ImGui::MenuItem((std::string(editor::lightKindName(kind)) + " light").c_str()))
            applyEdit(context, editor::addLight(newLight(context, kind)));
}

}  // namespace

bool hasSelectedInstances(const EditorContext& context) {
    return context.state.hasScene() && !selectionOf(context).instances.empty();
}

bool hasSelection(const EditorContext& context) {
    return context.state.hasScene() && !(selectionOf(context) == editor::Selection{});
}

void duplicateSelection(EditorContext& context) {
    const editor::Selection selection = selectionOf(context);
    if (!selection.instances.empty()) applyEdit(context, editor::duplicateInstances(selection.instances));
    if (selection.light) applyEdit(context, editor::duplicateLight(*selection.light));
    if (selection.camera) applyEdit(context, editor::addCamera(context.state.scene().cameras[*selection.camera]));
    if (selection.material)
        applyEdit(context, editor::addMaterial(context.state.scene().materials[*selection.material]));
}

void deleteSelection(EditorContext& context) {
    const editor::Selection selection = selectionOf(context);
    if (!selection.instances.empty()) applyEdit(context, editor::deleteInstances(selection.instances));
    if (selection.light) applyEdit(context, editor::deleteLight(*selection.light));
    if (selection.camera) applyEdit(context, editor::deleteCamera(*selection.camera));
    if (selection.material) applyEdit(context, editor::deleteMaterial(*selection.material));
}

void hideSelection(EditorContext& context) {
    const std::vector<uint32_t>& chosen = selectionOf(context).instances;
    const bool anyShown = std::ranges::any_of(chosen, [&](uint32_t i) { return !context.state.document->isHidden(i); });
    applyEdit(context, editor::showInstances(chosen, !anyShown));
}

void isolateSelection(EditorContext& context) {
    applyEdit(context, editor::isolateInstances(selectionOf(context).instances));
}

void showAllAgain(EditorContext& context) { applyEdit(context, editor::showAllInstances()); }

void selectAll(EditorContext& context) {
    editor::Selection all;
    all.instances.resize(context.state.scene().instances.size());
    std::iota(all.instances.begin(), all.instances.end(), 0u);
    context.state.document->select(all);
}

void selectNothing(EditorContext& context) { context.state.document->select({}); }

void drawSelectionMenu(EditorContext& context) {
    if (ImGui::MenuItem("Focus", "F")) focusSelection(context);
    ImGui::Separator();
    if (ImGui::MenuItem("Duplicate", "Ctrl+D")) duplicateSelection(context);
    if (ImGui::MenuItem("Delete", "Del")) deleteSelection(context);
    ImGui::Separator();
    if (ImGui::MenuItem("Hide or show", "H")) hideSelection(context);
    if (ImGui::MenuItem("Isolate", "Shift+H")) isolateSelection(context);
    if (ImGui::MenuItem("Show all", "Alt+H")) showAllAgain(context);
}

void drawAddMenu(EditorContext& context) {
    const Camera& camera = context.state.camera;
    for (const editor::Shape shape : editor::kShapes)
        if (ImGui::MenuItem(editor::shapeName(shape)))
            applyEdit(context, editor::addShape(shape, camera.target, kNewShare * editor::cameraRadius(camera)));
    ImGui::Separator();
    drawAddLights(context);
    ImGui::Separator();
    if (ImGui::MenuItem("camera from the view")) saveView(context);
    if (ImGui::MenuItem("material"))
        applyEdit(context, editor::addMaterial({.name = "material", .baseColor = glm::vec3(0.8f), .roughness = 0.5f}));
}

}  // namespace raylab
