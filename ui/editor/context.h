#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "ui/editor/background.h"
#include "ui/editor/config.h"
#include "ui/editor/editor_log.h"
#include "ui/editor/editor_state.h"
#include "ui/editor/file_dialog.h"
#include "ui/editor/images.h"
#include "ui/editor/model/document_file.h"
#include "ui/editor/model/edit_materials.h"
#include "ui/editor/model/gizmo.h"
#include "ui/editor/panel_states.h"
#include "ui/editor/render_session.h"
#include "ui/editor/window.h"

namespace raylab {

/// Where the viewport shows its picture, in ImGui's coordinates, for what is drawn over it.
struct ViewRectangle {
    float x = 0.0f, y = 0.0f, width = 0.0f, height = 0.0f;

    float aspect() const { return height > 0.0f ? width / height : 1.0f; }
};

class DocumentFiles;

/// A picture slot of a material.
struct TexturePlace {
    uint32_t material = 0;
    editor::TextureSlot slot = editor::TextureSlot::baseColor;
};

/// All that a panel may look at and do; lives as long as the editor. Panels keep their own state and know nothing of each
/// other.
struct EditorContext {
    EditorState& state;
    EditorConfig& config;
    RenderSession& session;
    Background& background;
    Background& measuring;  ///< times something, so that the viewport waits meanwhile
    ImagePainter& images;
    EditorLog& log;
    const Input& input;
    FileDialog& fileDialog;
    PanelStates& states;
    DocumentFiles& files;
    std::function<void(const std::filesystem::path&, OpenMode)> open;  ///< reads in the background
    /// A document in place of this one, and what comes after that; asks before edits are lost.
    std::function<void(editor::OpenedDocument, std::function<void()>)> show;
    std::function<void()> quit;                                       ///< at once; DocumentFiles::ask() asks before

    // Of this frame.
    RenderStatus status;
    std::shared_ptr<const Picture> picture;  ///< nullptr before the first
    std::optional<PickResult> picked;
    ViewRectangle view;
    /// Height that a panel which needs more than its pane has takes of the view while it is in front.
    float viewLent = 0.0f;
    /// Of the picture that the viewport has room for, pixels; with what is lent, so that no panel starts it over.
    uint32_t viewWidth = 0, viewHeight = 0;
    float scale = 1.0f;       ///< of the display
    double seconds = 0.0;     ///< since the frame before
    bool viewMoves = false;   ///< something keeps changing what is seen; set by who does
    double redrawSeconds = 1.0;  ///< until another frame is due, whatever happens; set by who moves by itself
    bool showKeys = false;
    editor::GizmoMode gizmoMode = editor::GizmoMode::move;
    editor::GizmoSpace gizmoSpace = editor::GizmoSpace::world;
    editor::GizmoSnap gizmoSnap;  ///< steps of the last drag, while Ctrl is down
    TexturePlace texturePlace;    ///< that the file dialog chooses a picture for
    std::string layoutRequest;  ///< name of a panel whose tab should come to the front
};

/// Applies an edit to the document, or logs why it cannot be. False where nothing changed.
bool applyEdit(EditorContext& context, const editor::Edit& edit);

/// The same for an edit that may fail to be made, as of a text from the clipboard.
bool tryEdit(EditorContext& context, const std::function<editor::Edit()>& make);

}  // namespace raylab
