#pragma once

#include <span>

#include "ui/editor/model/document.h"

/// Edits of what stands in the scene. Indices count Scene::instances and exist, unless a function says otherwise.
namespace raylab::editor {

struct Placement {
    uint32_t instance = 0;
    glm::mat4 objectToWorld{1.0f};
};

/// Puts instances where they are to be. Throws Error on apply for a matrix that is singular, not finite or no affine
/// map. `verb`: "Move", "Rotate", "Scale"; a drag gives all its edits one `mergeKey`.
Edit placeInstances(std::vector<Placement> placements, const std::string& verb, std::string mergeKey = {});

Edit renameInstance(uint32_t instance, std::string name);

/// Copies share the meshes of their originals, stand where these stand, and are selected.
Edit duplicateInstances(std::vector<uint32_t> instances);

/// Meshes stay in the scene, which keeps all other indices; the importer drops what nothing shows.
/// Throws Error on apply where it would leave no instance: a scene without surfaces cannot be saved.
Edit deleteInstances(std::vector<uint32_t> instances);

Edit showInstances(std::vector<uint32_t> instances, bool shown);
/// Hides all others.
Edit isolateInstances(std::vector<uint32_t> instances);
Edit showAllInstances();

/// Instances wear the material. Others that show the same mesh keep theirs: a mesh has one material, so that it is
/// copied for the instances at hand where it is shared.
Edit assignMaterial(std::vector<uint32_t> instances, uint32_t material);

/// Adds an instance, visible, and returns its index.
uint32_t insertInstance(EditState& state, Instance instance);

/// "NAME" or "3 instances", for names of edits.
std::string namesOf(const Scene& scene, std::span<const uint32_t> instances);

}  // namespace raylab::editor
