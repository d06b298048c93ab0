#include "ui/editor/actions.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <array>

#include "engine/core/file.h"
#include "ui/editor/compare.h"
#include "ui/editor/document_files.h"
#include "ui/editor/inspection_actions.h"
#include "ui/editor/scene_actions.h"
#include "ui/editor/view_actions.h"

namespace raylab {
namespace {

using editor::GizmoMode;
using editor::GizmoSpace;

constexpr std::array kMenus = {"File", "Edit", "View", "Help"};

bool hasScene(const EditorContext& context) { return context.state.hasScene(); }

bool isComparing(const EditorContext& context) { return context.states.get<Comparison>().isOn(); }

bool isLocal(const EditorContext& context) { return context.gizmoSpace == GizmoSpace::local; }

template <GizmoMode mode>
constexpr Action gizmoAction(const char* name, int key) {
    return {"Edit", name, key, 0, [](EditorContext& context) { context.gizmoMode = mode; }, nullptr,
            [](const EditorContext& context) { return context.gizmoMode == mode; }};
}

constexpr std::array kActions = {
    Action{"File", "Open...", GLFW_KEY_O, GLFW_MOD_CONTROL, [](EditorContext& context) { context.fileDialog.open(OpenMode::replace); }},
    Action{"File", "Merge...", 0, 0, [](EditorContext& context) { context.fileDialog.open(OpenMode::merge); }, hasScene},
    Action{"File", "Light by a map...", 0, 0, [](EditorContext& context) { context.fileDialog.open(OpenMode::environment); }, hasScene},
    Action{"File", "Save", GLFW_KEY_S, GLFW_MOD_CONTROL, [](EditorContext& context) { context.files.save(context); }, hasScene},
    Action{"File", "Save as...", GLFW_KEY_S, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT, [](EditorContext& context) { context.files.saveAs(context); }, hasScene},
    Action{"File", "Quit", GLFW_KEY_Q, GLFW_MOD_CONTROL, [](EditorContext& context) { context.files.ask(context, context.quit); }},
    Action{"Edit", "Undo", GLFW_KEY_Z, GLFW_MOD_CONTROL, [](EditorContext& context) { context.state.document->undo(); },
           [](const EditorContext& context) { return hasScene(context) && context.state.document->undoSteps() > 0; }},
    Action{"Edit", "Redo", GLFW_KEY_Y, GLFW_MOD_CONTROL, [](EditorContext& context) { context.state.document->redo(); },
           [](const EditorContext& context) { return hasScene(context) && context.state.document->redoSteps() > 0; }},
    Action{"Edit", "Duplicate", GLFW_KEY_D, GLFW_MOD_CONTROL, duplicateSelection, hasSelection},
    Action{"Edit", "Delete", GLFW_KEY_DELETE, 0, deleteSelection, hasSelection},
    Action{"Edit", "Hide or show", GLFW_KEY_H, 0, hideSelection, hasSelectedInstances},
    Action{"Edit", "Isolate", GLFW_KEY_H, GLFW_MOD_SHIFT, isolateSelection, hasSelectedInstances},
    Action{"Edit", "Show all again", GLFW_KEY_H, GLFW_MOD_ALT, showAllAgain, hasScene},
    Action{"Edit", "Select all", GLFW_KEY_A, GLFW_MOD_CONTROL, selectAll, hasScene},
    Action{"Edit", "Select nothing", GLFW_KEY_ESCAPE, 0, selectNothing, hasScene},
    gizmoAction<GizmoMode::move>("Move", GLFW_KEY_1),
    gizmoAction<GizmoMode::rotate>("Rotate", GLFW_KEY_2),
    gizmoAction<GizmoMode::scale>("Scale", GLFW_KEY_3),
    Action{"Edit", "Local axes", GLFW_KEY_4, 0,
           [](EditorContext& context) { context.gizmoSpace = isLocal(context) ? GizmoSpace::world : GizmoSpace::local; }, nullptr, isLocal},
    Action{"View", "Next tracer", GLFW_KEY_TAB, 0, nextTracer, hasScene},
    Action{"View", "Compare A with B", GLFW_KEY_V, 0, [](EditorContext& context) { context.states.get<Comparison>().toggle(context); }, hasScene, isComparing},
    Action{"View", "Swap A and B", GLFW_KEY_V, GLFW_MOD_SHIFT, [](EditorContext& context) { context.states.get<Comparison>().swap(context); }, isComparing},
    Action{"View", "Take B's settings", GLFW_KEY_V, GLFW_MOD_ALT, [](EditorContext& context) { context.states.get<Comparison>().giveToA(context); }, isComparing},
    Action{"View", "Focus selection", GLFW_KEY_F, 0, focusSelection, hasScene},
    Action{"View", "Show all", GLFW_KEY_HOME, 0, showAll, hasScene},
    Action{"View", "Copy camera", GLFW_KEY_C, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT, copyCamera, hasScene},
    Action{"View", "Paste camera", GLFW_KEY_V, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT, pasteCamera, hasScene},
    Action{"View", "Grid", GLFW_KEY_G, 0, [](EditorContext& context) { context.config.showGrid = !context.config.showGrid; },
           nullptr, [](const EditorContext& context) { return context.config.showGrid; }},
    Action{"View", "Pause rendering", GLFW_KEY_P, 0,
           [](EditorContext& context) { context.session.setPaused(context.status.phase != RenderPhase::paused); }, hasScene,
           [](const EditorContext& context) { return context.status.phase == RenderPhase::paused; }},
    Action{"View", "Reload kernels", GLFW_KEY_F5, 0, [](EditorContext& context) { context.session.reload(); context.states.get<Comparison>().reloadShaders(); }, hasScene},
    Action{"View", "Save view as camera", GLFW_KEY_K, GLFW_MOD_CONTROL, saveView, hasScene},
    Action{"View", "Render to PNG", GLFW_KEY_F11, 0, [](EditorContext& context) { renderToFile(context, ".png"); }, hasScene},
    Action{"View", "Render to EXR", GLFW_KEY_F11, GLFW_MOD_SHIFT, [](EditorContext& context) { renderToFile(context, ".exr"); }, hasScene},
    Action{"View", "Screenshot", GLFW_KEY_F12, 0, saveScreenshot,
           [](const EditorContext& context) { return context.picture != nullptr; }},
    Action{"View", "Boxes of the BVH", GLFW_KEY_B, 0, toggleBoxes, hasScene, showsBoxes},
    Action{"View", "Counts of the rays", GLFW_KEY_C, 0, toggleCounts, hasScene, showsCounts},
    Action{"View", "Pick a ray", GLFW_KEY_R, 0, startPicking, hasScene},
    Action{"View", "Ray: a step on", GLFW_KEY_RIGHT, 0, stepForward, hasRay},
    Action{"View", "Ray: a step back", GLFW_KEY_LEFT, 0, stepBack, hasRay},
    Action{"Help", "Keys", GLFW_KEY_F1, 0, [](EditorContext& context) { context.showKeys = !context.showKeys; }, nullptr,
           [](const EditorContext& context) { return context.showKeys; }},
};

bool isEnabled(const Action& action, const EditorContext& context) {
    return action.enabled == nullptr || action.enabled(context);
}

void drawRecent(EditorContext& context) {
    if (!ImGui::BeginMenu("Open recent", !context.config.recent.empty())) return;
    std::string chosen;
    for (const std::string& path : context.config.recent)
        if (ImGui::MenuItem(path.c_str())) chosen = path;
    ImGui::EndMenu();
    if (!chosen.empty()) context.open(chosen, OpenMode::replace);
}

/// Scenes that come with raylab.
void drawOwnScenes(EditorContext& context) {
    if (!ImGui::BeginMenu("Open example")) return;
    for (const auto& entry : std::filesystem::directory_iterator(dataFolder("assets"))) {
        if (entry.path().extension() != ".glb") continue;
        if (ImGui::MenuItem(entry.path().stem().string().c_str())) context.open(entry.path(), OpenMode::replace);
    }
    ImGui::EndMenu();
}

/// Undo and Redo say of what.
std::string nameOf(const Action& action, const EditorContext& context) {
    const std::string name(action.name);
    if (!context.state.hasScene() || (name != "Undo" && name != "Redo")) return name;
    const std::string step = name == "Undo" ? context.state.document->undoName() : context.state.document->redoName();
    return step.empty() ? name : name + " " + step + "###" + name;
}

/// The scene's cameras; one that is chosen becomes the view.
void drawCameras(EditorContext& context) {
    if (!ImGui::BeginMenu("Look through", hasScene(context) && !context.state.scene().cameras.empty())) return;
    int index = 0;
    for (const Camera& camera : context.state.scene().cameras) {
        ImGui::PushID(index++);
        if (ImGui::MenuItem(camera.name.empty() ? "camera" : camera.name.c_str())) context.state.camera = camera;
        ImGui::PopID();
    }
    ImGui::EndMenu();
}

void drawItem(const Action& action, EditorContext& context) {
    const std::string key = keyText(action.key, action.mods);
    const bool checked = action.checked != nullptr && action.checked(context);
    const std::string name = nameOf(action, context);
    if (ImGui::MenuItem(name.c_str(), key.c_str(), checked, isEnabled(action, context))) action.run(context);
}

void drawMenu(const char* menu, EditorContext& context) {
    if (!ImGui::BeginMenu(menu)) return;
    bool first = true;
    for (const Action& action : actionTable()) {
        if (action.menu != menu) continue;
        drawItem(action, context);
        if (first && std::string_view(menu) == "File") {
            drawRecent(context);
            drawOwnScenes(context);
            ImGui::Separator();
        }
        first = false;
    }
    if (std::string_view(menu) == "View") drawCameras(context);
    ImGui::EndMenu();
}

}  // namespace

std::span<const Action> actionTable() { return kActions; }

std::string keyText(int key, int mods) {
    if (key == 0) return "";
    std::string text;
    if ((mods & GLFW_MOD_CONTROL) != 0) text += "Ctrl+";
    if ((mods & GLFW_MOD_SHIFT) != 0) text += "Shift+";
    if ((mods & GLFW_MOD_ALT) != 0) text += "Alt+";
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return text + "F" + std::to_string(key - GLFW_KEY_F1 + 1);
    switch (key) {
        case GLFW_KEY_TAB: return text + "Tab";
        case GLFW_KEY_HOME: return text + "Home";
        case GLFW_KEY_DELETE: return text + "Del";
        case GLFW_KEY_ESCAPE: return text + "Esc";
        case GLFW_KEY_SPACE: return text + "Space";
        case GLFW_KEY_LEFT: return text + "Left";
        case GLFW_KEY_RIGHT: return text + "Right";
        default: return text + static_cast<char>(key);
    }
}

void runKeys(EditorContext& context) {
    if (ImGui::GetIO().WantTextInput || ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) return;
    for (const Action& action : actionTable())
        if (action.key != 0 && context.input.pressed(action.key, action.mods) && isEnabled(action, context)) action.run(context);
}

float drawMenuBar(EditorContext& context) {
    float height = 0.0f;
    if (ImGui::BeginMainMenuBar()) {
        for (const char* menu : kMenus) drawMenu(menu, context);
        height = ImGui::GetWindowSize().y;
        ImGui::EndMainMenuBar();
    }
    if (const auto path = context.fileDialog.draw(context.scale)) context.open(*path, context.fileDialog.mode());
    return height;
}

}  // namespace raylab
