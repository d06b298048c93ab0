#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ui/editor/model/edit_state.h"

namespace raylab::editor {

/// A list with the elements `before` from `first` on became the same list with `after` in their place.
template <class T>
struct Splice {
    size_t first = 0;
    std::vector<T> before;
    std::vector<T> after;

    bool isEmpty() const { return before.empty() && after.empty(); }
};

/// Name and material of a mesh whose triangles stayed as they were.
struct MeshLabelChange {
    uint32_t mesh = 0;
    std::string nameBefore, nameAfter;
    uint32_t materialBefore = 0, materialAfter = 0;
};

/// One value that became another.
template <class T>
struct Change {
    bool isChanged = false;
    T before{}, after{};
};

/// What two scenes differ by. Meshes, textures and the radiance map are told apart by what they share, not by their
/// contents.
struct SceneDelta {
    Change<std::string> name;
    Splice<Shared<Texture>> textures;
    Splice<Material> materials;
    Splice<Shared<Mesh>> meshes;
    std::vector<MeshLabelChange> meshLabels;
    Splice<Instance> instances;
    Splice<Camera> cameras;
    Splice<Light> lights;
    Change<SharedOptional<Environment>> environment;
    Change<std::optional<SkyDescription>> sky;

    bool isEmpty() const;
};

/// A row of renderSettingsTable() with another value.
struct SettingChange {
    size_t row = 0;
    SettingValue before, after;
};

/// What two states differ by: a few hundred bytes for an edit of one thing, whatever the size of the scene.
struct Delta {
    SceneDelta scene;
    Splice<uint8_t> hidden;
    std::vector<SettingChange> settings;
    Selection selectionBefore, selectionAfter;

    /// The selection alone is no difference.
    bool isEmpty() const;
    /// Of memory, without what the scene still shares.
    size_t bytes() const;
};

SceneDelta difference(const Scene& before, const Scene& after);
Delta difference(const EditState& before, const EditState& after);

/// Takes `state`, which must be the `before` of the delta, to the `after`; revert() goes back, bit for bit.
void apply(const Delta& delta, EditState& state);
void revert(const Delta& delta, EditState& state);

}  // namespace raylab::editor
