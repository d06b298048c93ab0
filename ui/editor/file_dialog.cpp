#include "ui/editor/file_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "engine/scene/import.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

std::string extensionsOf(OpenMode mode) {
    switch (mode) {
        case OpenMode::replace:
        case OpenMode::merge: return importableExtensions();
        case OpenMode::environment: return ".hdr .exr";
        case OpenMode::texture: return ".png .jpg .jpeg .tga .bmp";
        case OpenMode::save: return ".glb .gltf";
    }
    return "";
}

bool isReadable(const fs::path& path, OpenMode mode) {
    const std::string extension = path.extension().string();
    const std::string known = extensionsOf(mode);
    return !extension.empty() && (known + " ").find(extension + " ") != std::string::npos;
}

const char* titleOf(OpenMode mode) {
    switch (mode) {
        case OpenMode::replace: return "Open a scene";
        case OpenMode::merge: return "Merge a scene into this one";
        case OpenMode::environment: return "Open a sky";
        case OpenMode::texture: return "Open a picture";
        case OpenMode::save: return "Save the scene as";
    }
    return "";
}

}  // namespace

void FileDialog::open(OpenMode mode, const fs::path& name) {
    opening_ = true;
    mode_ = mode;
    const fs::path beside = name.has_parent_path() ? fs::absolute(name).parent_path() : folder_;
    enter(beside.empty() ? fs::current_path() : beside);
    text_ = name.filename().string();
}

/// A scene to be saved is a .glb where nothing else is said.
fs::path FileDialog::chosenFile() const {
    const fs::path file = folder_ / text_;
    return mode_ == OpenMode::save && !file.has_extension() ? fs::path(file.string() + ".glb") : file;
}

void FileDialog::enter(const fs::path& folder) {
    folder_ = folder;
    text_.clear();
    entries_.clear();
    std::error_code unreadable;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, unreadable)) {
        const bool hidden = entry.path().filename().string().front() == '.';
        std::error_code gone;
        if (!hidden && (entry.is_directory(gone) || isReadable(entry.path(), mode_))) entries_.push_back(entry);
    }
    std::ranges::sort(entries_, [](const fs::directory_entry& a, const fs::directory_entry& b) {
        std::error_code gone;
        return std::pair(!a.is_directory(gone), a.path()) < std::pair(!b.is_directory(gone), b.path());
    });
}

/// True where a file was chosen by a double click.
bool FileDialog::drawEntries() {
    bool chosen = false;
    std::optional<fs::path> entered;
    ImGui::BeginChild("entries", {0.0f, -ImGui::GetFrameHeightWithSpacing() * 2.0f}, true);
    if (folder_.has_relative_path() && ImGui::Selectable("..")) entered = folder_.parent_path();
    for (const fs::directory_entry& entry : entries_) {
        std::error_code gone;
        const bool isFolder = entry.is_directory(gone);
        const std::string name = entry.path().filename().string() + (isFolder ? "/" : "");
        if (!ImGui::Selectable(name.c_str(), text_ == name, ImGuiSelectableFlags_AllowDoubleClick)) continue;
        if (isFolder)
            entered = entry.path();
        else
            chosen = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
        text_ = name;
    }
    ImGui::EndChild();
    if (entered) enter(*entered);
    return chosen;
}

std::optional<fs::path> FileDialog::draw(float scale) {
    const char* title = titleOf(mode_);
    if (std::exchange(opening_, false)) ImGui::OpenPopup(title);
    ImGui::SetNextWindowSize({560.0f * scale, 420.0f * scale}, ImGuiCond_Appearing);
    if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_NoSavedSettings)) return {};
    ImGui::TextColored(color::kDim, "%s", folder_.string().c_str());
    bool chosen = drawEntries();
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    chosen = ImGui::InputText("##path", &text_, ImGuiInputTextFlags_EnterReturnsTrue) || chosen;
    std::error_code gone;
    const bool replaces = mode_ == OpenMode::save && !text_.empty() && fs::exists(chosenFile(), gone);
    const char* button = replaces ? "Replace" : mode_ == OpenMode::save ? "Save" : "Open";
    chosen = ImGui::Button(button, {90.0f * scale, 0.0f}) || chosen;
    ImGui::SameLine();
    const bool cancelled = ImGui::Button("Cancel", {90.0f * scale, 0.0f});
    chosen = chosen && !text_.empty();
    if (chosen || cancelled) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return chosen ? std::optional(chosenFile()) : std::nullopt;
}

}  // namespace raylab
