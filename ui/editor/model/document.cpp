#include "ui/editor/model/document.h"

#include <algorithm>

namespace raylab::editor {
namespace {

/// The oldest steps are forgotten beyond. Edits of single things never come near; many added meshes or radiance maps
/// may.
constexpr size_t kMostHistoryBytes = size_t{512} << 20;

constexpr uint64_t kNeverSaved = ~uint64_t{0};  ///< of no state

template <class List>
bool exists(const std::optional<uint32_t>& index, const List& list) {
    return index && *index < list.size();
}

Selection existing(const Selection& wanted, const Scene& scene) {
    Selection selection;
    for (const uint32_t instance : wanted.instances) {
        const auto& chosen = selection.instances;
        if (instance < scene.instances.size() && std::find(chosen.begin(), chosen.end(), instance) == chosen.end())
            selection.instances.push_back(instance);
    }
    if (exists(wanted.material, scene.materials)) selection.material = wanted.material;
    if (exists(wanted.light, scene.lights)) selection.light = wanted.light;
    if (exists(wanted.camera, scene.cameras)) selection.camera = wanted.camera;
    return selection;
}

}  // namespace

Document::Document(Scene scene, std::filesystem::path file, RenderSettings settings, std::vector<uint8_t> hidden)
    : file_(std::move(file)) {
    state_.scene = std::move(scene);
    state_.settings = std::move(settings);
    state_.hidden = std::move(hidden);
    state_.hidden.resize(state_.scene.instances.size(), 0);
}

std::shared_ptr<const Scene> Document::rendered() const {
    if (rendered_) return rendered_;
    auto scene = std::make_shared<Scene>(state_.scene);
    scene->instances.clear();
    renderedInstances_.clear();
    for (uint32_t i = 0; i < state_.scene.instances.size(); ++i) {
        if (state_.hidden[i] != 0) continue;
        scene->instances.push_back(state_.scene.instances[i]);
        renderedInstances_.push_back(i);
    }
    rendered_ = std::move(scene);
    return rendered_;
}

uint32_t Document::sceneInstance(uint32_t renderedInstance) const {
    static_cast<void>(rendered());
    return renderedInstances_.at(renderedInstance);
}

bool Document::continues(const Edit& edit) const {
    return mayMerge_ && !edit.mergeKey.empty() && !undo_.empty() && undo_.back().mergeKey == edit.mergeKey;
}

bool Document::apply(const Edit& edit) {
    EditState edited = state_;
    edit.change(edited);
    edited.selection = existing(edited.selection, edited.scene);
    if (difference(state_, edited).isEmpty()) {
        state_.selection = edited.selection;
        return false;
    }
    if (continues(edit)) dropLastStep();
    for (const Step& step : redo_) historyBytes_ -= step.delta.bytes();
    redo_.clear();
    Delta delta = difference(state_, edited);
    editor::apply(delta, state_);  // not `edited` itself: 0 and -0 are no difference, and undo is exact to the bit
    if (!delta.isEmpty()) addStep(edit, std::move(delta));
    mayMerge_ = true;
    changed();
    return true;
}

/// Back to the state before it.
void Document::dropLastStep() {
    revert(undo_.back().delta, state_);
    historyBytes_ -= undo_.back().delta.bytes();
    undo_.pop_back();
}

void Document::addStep(const Edit& edit, Delta&& delta) {
    const uint64_t id = nextId_++;
    const StateId after{id, delta.scene.isEmpty() ? stateId().scene : id};
    historyBytes_ += delta.bytes();
    undo_.push_back({edit.name, edit.mergeKey, std::move(delta), after});
    while (historyBytes_ > kMostHistoryBytes && undo_.size() > 1) forgetOldest();
}

void Document::forgetOldest() {
    historyBytes_ -= undo_.front().delta.bytes();
    baseId_ = undo_.front().id;
    undo_.pop_front();
}

void Document::changed() {
    ++revision_;
    rendered_.reset();
}

bool Document::undo() {
    if (undo_.empty()) return false;
    revert(undo_.back().delta, state_);
    redo_.push_back(std::move(undo_.back()));
    undo_.pop_back();
    mayMerge_ = false;
    changed();
    return true;
}

bool Document::redo() {
    if (redo_.empty()) return false;
    editor::apply(redo_.back().delta, state_);
    undo_.push_back(std::move(redo_.back()));
    redo_.pop_back();
    mayMerge_ = false;
    changed();
    return true;
}

std::string Document::undoName() const { return undo_.empty() ? "" : undo_.back().name; }

std::string Document::redoName() const { return redo_.empty() ? "" : redo_.back().name; }

void Document::select(const Selection& selection) { state_.selection = existing(selection, state_.scene); }

void Document::markSaved(const std::filesystem::path& file, StateId state) {
    file_ = file;
    savedId_ = state;
    mayMerge_ = false;
}

void Document::markRecovered(const std::filesystem::path& original) {
    file_ = original;
    savedId_ = {kNeverSaved, kNeverSaved};
}

}  // namespace raylab::editor
