#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ui/editor/model/document.h"
#include "ui/editor/model/project_file.h"

namespace raylab::editor {

struct OpenedDocument {
    Document document;
    std::optional<Camera> view;         ///< that it was saved with
    std::vector<std::string> warnings;  ///< the importer's, and those about the settings beside it
};

/// A scene of any format that is read, with the settings beside it (NAME.raylab.json); `settings` is what holds where
/// there are none. Takes as long as the import: call it beside the interface. Throws Error as importScene() and
/// readProject() do.
OpenedDocument openDocument(const std::filesystem::path& file, const RenderSettings& settings = {});

/// Whether Save can write to the file that the document was read from: it is a .glb or .gltf.
bool canSave(const Document& document);

/// What saving writes, taken at one moment: it can be written beside the interface while the editing goes on.
struct SaveJob {
    std::filesystem::path file;
    Scene scene;  ///< shares what is large with the document
    Project project;
    StateId state;  ///< for Document::markSaved

    /// The scene (saveGltf) and the settings beside it. Throws Error as saveDocument() does.
    void write() const;
};

/// Throws Error for a name that is none of a scene.
SaveJob prepareSave(const Document& document, const std::filesystem::path& file, const std::optional<Camera>& view);

/// Prepares, writes, and marks the document saved. Throws Error for a name that is none of a scene, and where the disk
/// is full or the folder read-only; then the old scene, the document and its edits are as they were, and it still counts
/// as unsaved.
void saveDocument(Document& document, const std::filesystem::path& file, const std::optional<Camera>& view);

}  // namespace raylab::editor
