#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "ui/editor/model/delta.h"

namespace raylab::editor {

/// A change with the name that the Edit menu shows. It may throw Error, and the document is then as before.
struct Edit {
    std::string name;
    std::function<void(EditState&)> change;
    /// Edits in a row with the same key, as a drag makes them, are one step; empty: a step of its own.
    std::string mergeKey = {};
};

/// Number of a state of a document, and of its scene, which several states may have in common.
struct StateId {
    uint64_t all = 0;
    uint64_t scene = 0;
};

/// A scene with its render settings and the history of its edits.
///
/// Scenes are values that share what is large (SharedList), so an edit works on a copy, and what it changed is the
/// difference of the two: no edit has to say how it is undone, undo is exact to the bit, and a step takes a few hundred
/// bytes in a scene of any size. Who renders holds a snapshot that nobody writes to. One thread uses a Document.
class Document {
public:
    /// `file`: where it was read from and Save writes to; empty for a new scene. `hidden`: as hidden(); empty: none.
    explicit Document(Scene scene, std::filesystem::path file = {}, RenderSettings settings = {},
                      std::vector<uint8_t> hidden = {});

    const Scene& scene() const { return state_.scene; }
    const RenderSettings& settings() const { return state_.settings; }
    bool isHidden(uint32_t instance) const { return state_.hidden[instance] != 0; }
    const std::vector<uint8_t>& hidden() const { return state_.hidden; }

    /// What is to be rendered: the scene without its hidden instances. The same pointer until it changes.
    std::shared_ptr<const Scene> rendered() const;
    /// Index in scene() of an instance of rendered().
    uint32_t sceneInstance(uint32_t renderedInstance) const;

    /// False where it changes nothing; then there is no step either.
    bool apply(const Edit& edit);
    /// The next edit is a new step, whatever its key: the mouse button is up.
    void endMerge() { mayMerge_ = false; }
    bool undo();
    bool redo();
    /// Names of what undo() and redo() would do; empty where there is nothing.
    std::string undoName() const;
    std::string redoName() const;
    size_t undoSteps() const { return undo_.size(); }
    size_t redoSteps() const { return redo_.size(); }
    size_t historyBytes() const { return historyBytes_; }

    /// Grows by each change of anything but the selection.
    uint64_t revision() const { return revision_; }

    /// Not a step of its own; undo restores the selection that a step began with. Indices that do not exist are left
    /// out.
    const Selection& selection() const { return state_.selection; }
    void select(const Selection& selection);

    const std::filesystem::path& file() const { return file_; }
    /// Whether the state differs from the one last saved: undoing back to that one makes it clean again.
    bool isUnsaved() const { return stateId().all != savedId_.all; }
    /// The same of the scene alone, without settings and hidden instances: what one asks before it is lost.
    bool isSceneUnsaved() const { return stateId().scene != savedId_.scene; }
    /// Of the state between two edits; undo and redo come back to it.
    StateId stateId() const { return undo_.empty() ? baseId_ : undo_.back().id; }
    /// The state of that number is on disk, at `file`; meanwhile there may have been edits.
    void markSaved(const std::filesystem::path& file, StateId state);
    void markSaved(const std::filesystem::path& file) { markSaved(file, stateId()); }
    /// It was read from elsewhere, as a copy of `original`, and differs from that: unsaved, whatever is undone.
    void markRecovered(const std::filesystem::path& original);

private:
    struct Step {
        std::string name;
        std::string mergeKey;
        Delta delta;
        StateId id;  ///< of the state after it
    };

    bool continues(const Edit& edit) const;
    void addStep(const Edit& edit, Delta&& delta);
    void dropLastStep();
    void forgetOldest();
    void changed();

    EditState state_;
    std::filesystem::path file_;
    std::deque<Step> undo_;  ///< the newest last
    std::deque<Step> redo_;  ///< the next last
    size_t historyBytes_ = 0;
    bool mayMerge_ = false;
    uint64_t revision_ = 0;
    uint64_t nextId_ = 1;
    StateId baseId_;  ///< of the state before the oldest step
    StateId savedId_;
    mutable std::shared_ptr<const Scene> rendered_;
    mutable std::vector<uint32_t> renderedInstances_;
};

}  // namespace raylab::editor
