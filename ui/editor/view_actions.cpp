#include "ui/editor/view_actions.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/image/image8.h"
#include "engine/scene/bounds.h"
#include "ui/editor/bvh_overlay.h"
#include "ui/editor/camera_control.h"
#include "ui/editor/file_render.h"
#include "ui/editor/free_name.h"
#include "ui/editor/model/edit_cameras.h"

namespace raylab {
namespace {

/// In the order in which Tab goes through them.
constexpr std::array kTracers = {"software", "query", "pipeline"};

/// Around what is selected; nothing where that has no size.
std::optional<Bounds> selectedBox(const EditorState& state) {
    const editor::Selection& selection = state.document->selection();
    if (selection.instances.empty()) return {};
    Scene chosen;
    chosen.meshes = state.scene().meshes;
    for (const uint32_t index : selection.instances) chosen.instances.push_back(state.scene().instances[index]);
    return sceneBounds(chosen);
}

/// Of the scene.
std::filesystem::path freeName(const EditorContext& context, const std::string& extension) {
    const std::string stem = context.state.document->file().stem().string();
    return freeFileName("raylab-" + (stem.empty() ? "scene" : stem), extension);
}

}  // namespace

void nextTracer(EditorContext& context) {
    const auto at = std::ranges::find(kTracers, context.state.settings().tracer);
    const size_t next = at == kTracers.end() ? 0 : static_cast<size_t>(at - kTracers.begin() + 1) % kTracers.size();
    applyEdit(context, {"Tracer " + std::string(kTracers[next]),
                        [next](editor::EditState& state) { state.settings.tracer = kTracers[next]; }});
}

void focusSelection(EditorContext& context) {
    const EditorState& state = context.state;
    const editor::Selection& selection = state.document->selection();
    if (const auto node = selectedNodeBox(context))
        frameBox(context.state.camera, *node, context.view.aspect());
    else if (const auto box = selectedBox(state))
        frameBox(context.state.camera, *box, context.view.aspect());
    else if (selection.light)
        setPivot(context.state.camera, state.scene().lights[*selection.light].position);
    else if (selection.camera)
        context.state.camera = state.scene().cameras[*selection.camera];
    else
        showAll(context);
}

void showAll(EditorContext& context) {
    frameBox(context.state.camera, sceneBounds(context.state.scene()), context.view.aspect());
}

void copyCamera(EditorContext& context) {
    ImGui::SetClipboardText(editor::cameraText(context.state.camera).c_str());
    logInfo("the camera is on the clipboard");
}

void pasteCamera(EditorContext& context) {
    const char* text = ImGui::GetClipboardText();
    try {
        context.state.camera = editor::parseCamera(text != nullptr ? text : "");
    } catch (const Error& error) {
        logError(std::string("paste: ") + error.what());
    }
}

void saveScreenshot(EditorContext& context) {
    const std::filesystem::path path = freeName(context, ".png");
    context.background.start(
        "Writing a screenshot", [picture = context.picture, path](JobControl&) -> Background::Finish {
            writeFileAtomically(path, encodePng8(picture->texels, picture->width, picture->height));
            logInfo("screenshot: " + std::filesystem::absolute(path).string());
            return [] {};
        });
}

void saveView(EditorContext& context) {
    Camera camera = context.state.camera;
    camera.name = "view " + std::to_string(context.state.scene().cameras.size() + 1);
    if (applyEdit(context, editor::addCamera(camera))) logInfo("the view is camera '" + camera.name + "'");
}

void renderToFile(EditorContext& context, const std::string& extension) {
    const std::filesystem::path path = freeName(context, extension);
    context.background.start(
        "Rendering " + path.string(),
        [scene = context.state.document->rendered(), camera = context.state.camera, settings = context.state.settings(),
         path, shaders = context.session.share().shaders](JobControl& control) {
            renderImage(*scene, camera, settings, path, *shaders, control);
            return Background::Finish([] {});
        });
}

}  // namespace raylab
