#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "shaders/shared/needs.h"

namespace raylab {

/// One feature of the kernel: whether this scene needs it, and why (or why not).
struct Need {
    uint32_t bit = 0;  ///< shared::kNeed...
    std::string name;
    bool needed = false;
    std::string reason;  ///< names or counts what asks for it
};

/// What a scene uses, hence what the kernel specialised to it contains.
struct SceneNeeds {
    uint32_t mask = 0;
    std::vector<Need> needs;  ///< all features, in the order of their bits
};

/// How the trees are laid out: a mesh has a tree of its own below an instance where it is shown more than once, or where
/// its detail is too fine for the grid of a tree that spans the world; all others are merged into one tree in world space.
struct TreePlan {
    std::vector<uint32_t> useCount;  ///< instances by mesh
    std::vector<bool> ownTree;       ///< by mesh; false also for meshes that no instance shows
    size_t sharedMeshes = 0;         ///< shown more than once
    size_t fineMeshes = 0;           ///< shown once, with a tree of their own

    bool hasUpperTree() const { return sharedMeshes + fineMeshes > 0; }
};

TreePlan planTrees(const Scene& scene);

/// Walks the scene's data once. `scene.environment` and the lights must be those that will be rendered.
SceneNeeds analyseNeeds(const Scene& scene);

}  // namespace raylab
