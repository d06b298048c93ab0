#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "ui/editor/context.h"
#include "ui/editor/model/autosave.h"

namespace raylab {

/// Documents as files: saving beside the interface, autosave, recovery after a crash, and the question before edits are
/// lost.
class DocumentFiles {
public:
    /// Looks for what a crash has left. Without a folder for autosave there is none, which is logged.
    explicit DocumentFiles(std::chrono::seconds autosaveInterval);

    /// To the document's file; asks for a name where it has none that scenes are saved under.
    void save(EditorContext& context);
    void saveAs(EditorContext& context);
    void saveTo(EditorContext& context, const std::filesystem::path& file);

    /// Does `then` at once where there is nothing to lose, or else when the user has saved or does not want to.
    void ask(EditorContext& context, std::function<void()> then);

    /// Autosave, and the dialogs while they are open. `adopt` takes what is recovered.
    void draw(EditorContext& context, const std::function<void(editor::OpenedDocument&&)>& adopt);

    /// The editor ends, and the user has been asked.
    void leave();

private:
    void saveOrName(EditorContext& context);
    void drawQuestion(EditorContext& context);
    void drawRecovery(EditorContext& context, const std::function<void(editor::OpenedDocument&&)>& adopt);

    std::unique_ptr<editor::Autosave> autosave_;
    std::vector<editor::Recoverable> recoverable_;
    std::function<void()> then_;       ///< waits for the answer to the question
    std::function<void()> afterSave_;  ///< waits for the name of a file, then for it to be written
    bool asks_ = false;
};

}  // namespace raylab
