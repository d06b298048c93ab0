#include "ui/editor/model/document_file.h"

#include "engine/core/error.h"
#include "engine/scene/import.h"
#include "engine/scene/save_gltf.h"

namespace raylab::editor {

OpenedDocument openDocument(const std::filesystem::path& file, const RenderSettings& settings) {
    Scene scene = importScene(file);
    std::vector<std::string> warnings = scene.warnings;
    const std::filesystem::path beside = projectFile(file);
    const bool hasProject = std::filesystem::exists(beside);
    Project project = readProject(beside, scene.instances.size());
    project.settings.device = settings.device;
    project.settings.validation = settings.validation;
    warnings.insert(warnings.end(), project.warnings.begin(), project.warnings.end());
    return {Document(std::move(scene), file, hasProject ? project.settings : settings, std::move(project.hidden)),
            project.view, std::move(warnings)};
}

bool canSave(const Document& document) {
    try {
        if (document.file().empty()) return false;
        requireSavable(document.file());
        return true;
    } catch (const Error&) {
        return false;
    }
}

SaveJob prepareSave(const Document& document, const std::filesystem::path& file, const std::optional<Camera>& view) {
    requireSavable(file);
    return {file, document.scene(), {document.settings(), view, document.hidden(), {}}, document.stateId()};
}

void SaveJob::write() const {
    saveGltf(scene, file);
    writeProject(projectFile(file), project);
}

void saveDocument(Document& document, const std::filesystem::path& file, const std::optional<Camera>& view) {
    const SaveJob job = prepareSave(document, file, view);
    job.write();
    document.markSaved(file, job.state);
}

}  // namespace raylab::editor
