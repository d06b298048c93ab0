#include "ui/editor/document_files.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <chrono>
#include <ctime>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

constexpr const char* kQuestion = "Unsaved changes";
constexpr const char* kRecovery = "Recover edits";

std::string timeText(std::filesystem::file_time_type time) {
    const auto system = std::chrono::file_clock::to_sys(time);
    const std::time_t seconds =
        std::chrono::system_clock::to_time_t(std::chrono::time_point_cast<std::chrono::seconds>(system));
    char text[32] = "";
    std::tm local{};
    if (::localtime_r(&seconds, &local) != nullptr) std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M", &local);
    return text;
}

/// A dialog in the middle of the window. False while it is shut; otherwise ImGui::EndPopup() is due.
bool beginDialog(const char* title, float width) {
    ImGui::OpenPopup(title);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.45f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({width, 0.0f});
    return ImGui::BeginPopupModal(
        title, nullptr, ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
}

void openNames(EditorContext& context) {
    std::filesystem::path name = context.state.document->file();
    if (!editor::canSave(*context.state.document)) name.replace_extension(".glb");
    context.fileDialog.open(OpenMode::save, name);
}

}  // namespace

DocumentFiles::DocumentFiles(std::chrono::seconds autosaveInterval) {
    try {
        const std::filesystem::path folder = editor::autosaveFolder();
        recoverable_ = editor::findRecoverable(folder);
        autosave_ = std::make_unique<editor::Autosave>(folder, autosaveInterval);
    } catch (const Error& error) {
        logWarning(std::string("no autosave: ") + error.what());
    }
}

void DocumentFiles::save(EditorContext& context) {
    afterSave_ = {};
    saveOrName(context);
}

void DocumentFiles::saveAs(EditorContext& context) {
    afterSave_ = {};
    openNames(context);
}

void DocumentFiles::saveOrName(EditorContext& context) {
    if (editor::canSave(*context.state.document))
        saveTo(context, context.state.document->file());
    else
        openNames(context);
}

void DocumentFiles::saveTo(EditorContext& context, const std::filesystem::path& file) {
    try {
        const editor::Document* document = context.state.document.get();
        auto job = std::make_shared<editor::SaveJob>(editor::prepareSave(*document, file, context.state.camera));
        context.background.start(
            "Writing " + file.filename().string(),
            [job, document, then = std::exchange(afterSave_, {}), &context](JobControl&) -> Background::Finish {
                job->write();
                return [job, document, then, &context] {
                    logInfo("saved " + job->file.string());
                    context.config.addRecent(job->file);
                    if (context.state.document.get() == document)
                        context.state.document->markSaved(job->file, job->state);
                    if (then) then();
                };
            });
    } catch (const Error& error) {
        logError(error.what());
    }
}

void DocumentFiles::ask(EditorContext& context, std::function<void()> then) {
    if (!context.state.hasScene() || !context.state.document->isSceneUnsaved()) return then();
    then_ = std::move(then);
    asks_ = true;
}

void DocumentFiles::drawQuestion(EditorContext& context) {
    if (!asks_ || !beginDialog(kQuestion, 420.0f * context.scale)) return;
    const std::string name = context.state.document->file().filename().string();
    ImGui::TextWrapped("%s has changes that are not saved.", name.empty() ? "The scene" : name.c_str());
    ImGui::Spacing();
    const ImVec2 button(122.0f * context.scale, 0.0f);
    const bool save = ImGui::Button("Save", button);
    ImGui::SameLine();
    const bool drop = ImGui::Button("Do not save", button);
    ImGui::SameLine();
    const bool cancel = ImGui::Button("Cancel", button) || context.input.pressed(GLFW_KEY_ESCAPE);
    if (save || drop || cancel) {
        ImGui::CloseCurrentPopup();
        asks_ = false;
    }
    ImGui::EndPopup();
    if (save) {
        afterSave_ = std::exchange(then_, {});
        saveOrName(context);
    } else if (drop) {
        std::exchange(then_, {})();
    } else if (cancel) {
        then_ = {};
    }
}

void DocumentFiles::drawRecovery(EditorContext& context, const std::function<void(editor::OpenedDocument&&)>& adopt) {
    if (recoverable_.empty() || asks_ || !beginDialog(kRecovery, 460.0f * context.scale)) return;
    const editor::Recoverable copy = recoverable_.front();
    const std::string name = copy.original.empty() ? "a scene that was never saved" : copy.original.string();
    ImGui::TextWrapped("raylab ended while this had unsaved changes:");
    ImGui::TextWrapped("%s", name.c_str());
    ImGui::TextColored(color::kDim, "copy of %s", timeText(copy.time).c_str());
    ImGui::Spacing();
    const ImVec2 button(136.0f * context.scale, 0.0f);
    const bool recover = ImGui::Button("Recover", button);
    ImGui::SameLine();
    const bool discard = ImGui::Button("Throw away", button);
    ImGui::SameLine();
    const bool later = ImGui::Button("Not now", button);
    if (recover || discard || later) {
        ImGui::CloseCurrentPopup();
        recoverable_.erase(recoverable_.begin());
    }
    ImGui::EndPopup();
    if (discard) editor::discard(copy);
    if (!recover) return;
    recoverable_.clear();  // the next start asks for the others
    context.background.start("Recovering " + name, [copy, adopt](JobControl&) -> Background::Finish {
        auto opened = std::make_shared<editor::OpenedDocument>(editor::recover(copy));
        return [copy, opened, adopt] {
            adopt(std::move(*opened));
            editor::discard(copy);
        };
    });
}

void DocumentFiles::draw(EditorContext& context, const std::function<void(editor::OpenedDocument&&)>& adopt) {
    drawQuestion(context);
    drawRecovery(context, adopt);
    if (autosave_ == nullptr || !context.state.hasScene()) return;
    autosave_->update(*context.state.document, context.state.camera);
    if (const std::string problem = autosave_->takeProblem(); !problem.empty()) logWarning(problem);
}

void DocumentFiles::leave() {
    if (autosave_ != nullptr) autosave_->discard();
}

}  // namespace raylab
