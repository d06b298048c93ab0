#include "ui/editor/panels/inspector.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/editor/model/edit_instances.h"
#include "ui/editor/model/transform_parts.h"
#include "ui/editor/panels.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

constexpr float kLabelWidth = 96.0f;

bool dragTriple(const char* label, glm::dvec3& value, float speed, const char* format) {
    return ImGui::DragScalarN(label, ImGuiDataType_Double, &value.x, 3, speed, nullptr, nullptr, format);
}

void drawTransform(EditorContext& context, uint32_t index) {
    const Instance& instance = context.state.scene().instances[index];
    auto parts = editor::partsOf(instance.objectToWorld);
    if (!parts) {
        ImGui::TextWrapped("Its matrix shears: move and turn it with the handles in the viewport.");
        return;
    }
    const std::string key = "parts " + std::to_string(index);
    const auto place = [&](const char* verb) {
        applyEdit(context, editor::placeInstances({{index, editor::matrixOf(*parts)}}, verb, key + verb));
    };
    if (dragTriple("position", parts->translation, 0.01f, "%.3f")) place("Move");
    if (dragTriple("rotation", parts->rotationDegrees, 0.5f, "%.1f")) place("Rotate");
    inspectorTip("Degrees about x, y and z, in this order");
    if (dragTriple("scale", parts->scale, 0.005f, "%.3f")) place("Scale");
    if (ImGui::SmallButton("Reset")) applyEdit(context, editor::placeInstances({{index, glm::mat4(1.0f)}}, "Reset"));
    inspectorTip("To where the mesh's own coordinates put it");
}

void drawMeshFacts(const Scene& scene, uint32_t mesh) {
    const Mesh& m = scene.meshes[mesh];
    size_t sharing = 0;
    for (const Instance& instance : scene.instances) sharing += instance.mesh == mesh ? 1 : 0;
    const std::string name = m.name.empty() ? "mesh " + std::to_string(mesh) : m.name;
    if (m.quadrics.empty())
        ImGui::TextColored(color::kDim, "%s: %zu triangles, %zu vertices", name.c_str(), m.triangles.size(),
                           m.positions.size());
    else
        ImGui::TextColored(color::kDim, "%s: %zu quadrics", name.c_str(), m.quadrics.size());
    if (sharing > 1) ImGui::TextColored(color::kDim, "shown by %zu instances", sharing);
}

/// Chooses the material of all selected instances.
void drawAssignment(EditorContext& context, uint32_t worn) {
    const Scene& scene = context.state.scene();
    const auto nameOf = [&](uint32_t m) {
        return scene.materials[m].name.empty() ? "material " + std::to_string(m) : scene.materials[m].name;
    };
    std::optional<uint32_t> chosen;
    if (ImGui::BeginCombo("material", nameOf(worn).c_str(), ImGuiComboFlags_HeightLarge)) {
        for (uint32_t m = 0; m < scene.materials.size(); ++m) {
            ImGui::PushID(static_cast<int>(m));
            if (ImGui::Selectable(nameOf(m).c_str(), m == worn)) chosen = m;
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    inspectorTip("What the selected instances wear; or drag one from the Scene panel onto a thing");
    if (chosen) applyEdit(context, editor::assignMaterial(context.state.document->selection().instances, *chosen));
}

}  // namespace

void inspectorHeading(const char* text) {
    ImGui::Spacing();
    ImGui::Separator();
    ImGui::TextColored(color::kDim, "%s", text);
}

bool editName(std::string& name) {
    std::string edited = name;
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::InputTextWithHint("##name", "name", &edited);
    if (!ImGui::IsItemDeactivatedAfterEdit() || edited == name) return false;
    name = edited;
    return true;
}

void inspectorTip(const char* text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

void inspectInstances(EditorContext& context) {
    const std::vector<uint32_t> chosen = context.state.document->selection().instances;
    const uint32_t active = chosen.back();
    std::string name = context.state.scene().instances[active].name;
    if (chosen.size() > 1) ImGui::TextColored(color::kAccent, "%zu instances; the last one is shown", chosen.size());
    if (editName(name)) applyEdit(context, editor::renameInstance(active, name));
    drawTransform(context, active);
    const uint32_t mesh = context.state.scene().instances[active].mesh;
    drawMeshFacts(context.state.scene(), mesh);
    inspectorHeading("Material");
    drawAssignment(context, context.state.scene().meshes[mesh].material);
    inspectMaterial(context, context.state.scene().meshes[context.state.scene().instances[active].mesh].material);
}

void drawInspectorPanel(EditorContext& context) {
    if (!context.state.hasScene()) {
        ImGui::TextColored(color::kDim, "No scene.");
        return;
    }
    ImGui::PushItemWidth(-kLabelWidth * context.scale);
    const editor::Selection& selection = context.state.document->selection();
    if (!selection.instances.empty()) {
        inspectInstances(context);
    } else if (selection.material) {
        inspectMaterial(context, *selection.material);
    } else if (selection.light) {
        inspectLight(context, *selection.light);
    } else if (selection.camera) {
        inspectCamera(context, *selection.camera);
    } else {
        inspectView(context);
        inspectSurroundings(context);
    }
    ImGui::PopItemWidth();
}

}  // namespace raylab
