#include <imgui.h>

#include <algorithm>
#include <optional>

#include "ui/editor/model/edit_cameras.h"
#include "ui/editor/model/edit_instances.h"
#include "ui/editor/model/edit_lights.h"
#include "ui/editor/model/edit_materials.h"
#include "ui/editor/panel_parts.h"
#include "ui/editor/panels.h"
#include "ui/editor/scene_actions.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

struct Search {
    ImGuiTextFilter filter;
};

constexpr const char* kMaterialDrag = "raylab material";

std::string nameOf(const std::string& name, const char* kind, size_t index) {
    return name.empty() ? std::string(kind) + " " + std::to_string(index) : name;
}

/// Indices of the things whose names match the search.
template <class Things>
std::vector<uint32_t> matching(const Things& things, const char* kind, const ImGuiTextFilter& filter) {
    std::vector<uint32_t> found;
    for (uint32_t i = 0; i < things.size(); ++i)
        if (!filter.IsActive() || filter.PassFilter(nameOf(things[i].name, kind, i).c_str())) found.push_back(i);
    return found;
}

/// A group that opens; its title counts what is shown of how many there are.
bool beginGroup(const char* title, size_t shown, size_t total, bool open) {
    ImGui::SetNextItemOpen(open, ImGuiCond_Once);
    const std::string count =
        shown == total ? std::to_string(total) : std::to_string(shown) + " of " + std::to_string(total);
    return ImGui::TreeNodeEx(title, ImGuiTreeNodeFlags_SpanAvailWidth, "%s  %s", title, count.c_str());
}

/// With Ctrl one more or less, with Shift all from the last one to this, else this one alone.
void clickInstance(editor::Document& document, uint32_t index, const std::vector<uint32_t>& listed) {
    editor::Selection selection{.instances = document.selection().instances};
    std::vector<uint32_t>& chosen = selection.instances;
    const auto at = std::ranges::find(chosen, index);
    if (ImGui::GetIO().KeyShift && !chosen.empty()) {
        const uint32_t from = std::min(chosen.back(), index), to = std::max(chosen.back(), index);
        for (const uint32_t i : listed)
            if (i >= from && i <= to) chosen.push_back(i);
    } else if (ImGui::GetIO().KeyCtrl) {
        if (at == chosen.end())
            chosen.push_back(index);
        else
            chosen.erase(at);
    } else {
        chosen = {index};
    }
    document.select(selection);
}

/// An eye that is open or shut. True where it was clicked.
bool drawEye(bool shown) {
    const float side = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::InvisibleButton("eye", {1.4f * side, side});
    const ImU32 ink = ImGui::GetColorU32(ImGui::IsItemHovered() ? color::kAccent : shown ? color::kText : color::kDim);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip(shown ? "Hide" : "Show");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 middle(at.x + 0.7f * side, at.y + 0.5f * side);
    const float half = 0.48f * side;
    const ImVec2 left(middle.x - half, middle.y), right(middle.x + half, middle.y);
    if (shown) {
        list.AddBezierQuadratic(left, {middle.x, middle.y - 0.75f * half}, right, ink, 1.2f);
        list.AddBezierQuadratic(left, {middle.x, middle.y + 0.75f * half}, right, ink, 1.2f);
        list.AddCircleFilled(middle, 0.2f * side, ink);
    } else {
        list.AddBezierQuadratic(left, {middle.x, middle.y + 0.75f * half}, right, ink, 1.2f);
    }
    return clicked;
}

void takeMaterialDrop(EditorContext& context, uint32_t instance) {
    if (!ImGui::BeginDragDropTarget()) return;
    if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(kMaterialDrag)) {
        const std::vector<uint32_t>& chosen = context.state.document->selection().instances;
        const bool isChosen = std::ranges::find(chosen, instance) != chosen.end();
        applyEdit(context, editor::assignMaterial(isChosen ? chosen : std::vector{instance},
                                                  *static_cast<const uint32_t*>(payload->Data)));
    }
    ImGui::EndDragDropTarget();
}

void drawInstanceMenu(EditorContext& context, uint32_t index) {
    if (!ImGui::BeginPopupContextItem("menu")) return;
    const std::vector<uint32_t>& chosen = context.state.document->selection().instances;
    if (std::ranges::find(chosen, index) == chosen.end()) context.state.document->select({.instances = {index}});
    drawSelectionMenu(context);
    ImGui::EndPopup();
}

void drawInstanceRow(EditorContext& context, uint32_t index, const std::vector<uint32_t>& listed) {
    editor::Document& document = *context.state.document;
    const std::vector<uint32_t>& chosen = document.selection().instances;
    const bool isSelected = std::ranges::find(chosen, index) != chosen.end();
    const bool shown = !document.isHidden(index);
    ImGui::PushID(static_cast<int>(index));
    const bool toggled = drawEye(shown);
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, shown ? color::kText : color::kDim);
    const std::string name = nameOf(document.scene().instances[index].name, "instance", index);
    const bool clicked = ImGui::Selectable(name.c_str(), isSelected, ImGuiSelectableFlags_AllowDoubleClick);
    ImGui::PopStyleColor();
    takeMaterialDrop(context, index);
    drawInstanceMenu(context, index);
    ImGui::PopID();
    if (clicked) clickInstance(document, index, listed);
    if (clicked && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) focusSelection(context);
    if (toggled) applyEdit(context, editor::showInstances({index}, !shown));
}

void drawInstances(EditorContext& context, const ImGuiTextFilter& filter) {
    const Scene& scene = context.state.scene();
    const std::vector<uint32_t> listed = matching(scene.instances, "instance", filter);
    if (!beginGroup("Instances", listed.size(), scene.instances.size(), true)) return;
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(listed.size()));
    while (clipper.Step())
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
            const uint32_t index = listed[static_cast<size_t>(row)];
            if (index < context.state.scene().instances.size()) drawInstanceRow(context, index, listed);
        }
    ImGui::TreePop();
}

/// A plain list. `select` makes a selection of an index, `menu` draws what a right click offers.
template <class Things, class Select, class Menu>
void drawList(EditorContext& context, const char* title, const char* kind, const Things& things,
              const ImGuiTextFilter& filter, Select&& select, Menu&& menu) {
    const std::vector<uint32_t> listed = matching(things, kind, filter);
    if (!beginGroup(title, listed.size(), things.size(), filter.IsActive())) return;
    const editor::Selection before = context.state.document->selection();
    std::vector<std::string> names;
    for (const uint32_t i : listed) names.push_back(nameOf(things[i].name, kind, i));
    for (size_t row = 0; row < listed.size(); ++row) {
        ImGui::PushID(static_cast<int>(listed[row]));
        const editor::Selection wanted = select(listed[row]);
        if (ImGui::Selectable(names[row].c_str(), wanted == before)) context.state.document->select(wanted);
        if (ImGui::BeginPopupContextItem("menu")) {
            menu(listed[row]);
            ImGui::EndPopup();
        }
        ImGui::PopID();
    }
    ImGui::TreePop();
}

void drawLights(EditorContext& context, const ImGuiTextFilter& filter) {
    drawList(
        context, "Lights", "light", context.state.scene().lights, filter,
        [](uint32_t i) { return editor::Selection{.light = i}; },
        [&](uint32_t i) {
            if (ImGui::MenuItem("Duplicate")) applyEdit(context, editor::duplicateLight(i));
            if (ImGui::MenuItem("Delete")) applyEdit(context, editor::deleteLight(i));
        });
}

void drawCameras(EditorContext& context, const ImGuiTextFilter& filter) {
    drawList(
        context, "Cameras", "camera", context.state.scene().cameras, filter,
        [](uint32_t i) { return editor::Selection{.camera = i}; },
        [&](uint32_t i) {
            if (ImGui::MenuItem("Look through it")) context.state.camera = context.state.scene().cameras[i];
            if (ImGui::MenuItem("Delete")) applyEdit(context, editor::deleteCamera(i));
        });
}

/// Each can be dragged onto an instance of the list or onto a thing in the viewport.
void drawMaterials(EditorContext& context, const ImGuiTextFilter& filter) {
    const Scene& scene = context.state.scene();
    const std::vector<uint32_t> listed = matching(scene.materials, "material", filter);
    if (!beginGroup("Materials", listed.size(), scene.materials.size(), filter.IsActive())) return;
    std::optional<uint32_t> removed;
    for (const uint32_t i : listed) {
        const Material& m = scene.materials[i];
        const std::string name = nameOf(m.name, "material", i);
        ImGui::PushID(static_cast<int>(i));
        const float side = ImGui::GetTextLineHeight();
        ImGui::ColorButton("##color", {m.baseColor.x, m.baseColor.y, m.baseColor.z, 1.0f},
                           ImGuiColorEditFlags_NoTooltip, {side, side});
        ImGui::SameLine();
        if (ImGui::Selectable(name.c_str(), context.state.document->selection() == editor::Selection{.material = i}))
            context.state.document->select({.material = i});
        if (ImGui::BeginDragDropSource()) {
            ImGui::SetDragDropPayload(kMaterialDrag, &i, sizeof(i));
            ImGui::TextUnformatted(name.c_str());
            ImGui::EndDragDropSource();
        }
        if (ImGui::BeginPopupContextItem("menu")) {
            if (ImGui::MenuItem("Delete")) removed = i;
            ImGui::EndPopup();
        }
        ImGui::PopID();
    }
    ImGui::TreePop();
    if (removed) applyEdit(context, editor::deleteMaterial(*removed));
}

}  // namespace

std::optional<uint32_t> draggedMaterial() {
    const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(kMaterialDrag);
    return payload == nullptr ? std::nullopt : std::optional(*static_cast<const uint32_t*>(payload->Data));
}

void drawScenePanel(EditorContext& context) {
    ImGuiTextFilter& filter = context.states.get<Search>().filter;
    if (!context.state.hasScene()) {
        ImGui::TextColored(color::kDim, "No scene.");
        return;
    }
    if (ImGui::Button("Add")) ImGui::OpenPopup("add");
    if (ImGui::BeginPopup("add")) {
        drawAddMenu(context);
        ImGui::EndPopup();
    }
    ImGui::SameLine();
    searchField("##search", filter, "Search by name");
    drawInstances(context, filter);
    drawLights(context, filter);
    drawCameras(context, filter);
    drawMaterials(context, filter);
}

}  // namespace raylab
