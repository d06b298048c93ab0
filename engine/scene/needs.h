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

/// What decides how many trees there are.
struct TreePlanConfig {
    /// Triangles that a scene may show and still have all of them in one tree in world space, instances of one mesh included:
    /// rays are faster then, at the price of memory.
    size_t flattenLimit = 4'000'000;
    bool gridOverTree = false;  ///< boxes are quantised on a grid over a whole tree, which has only so many steps
    bool treePerMesh = false;   ///< each mesh has a tree of its own, however often it is shown
};

/// How the trees are laid out. All in one tree in world space, unless the scene shows too many triangles: then a mesh that is
/// shown more than once has a tree of its own below its instances, and so has one whose detail is too fine for a grid over the
/// world, and one of which an instance moves. Or every mesh has one.
struct TreePlan {
    std::vector<uint32_t> useCount;  ///< instances by mesh
    std::vector<bool> ownTree;       ///< by mesh; false also for meshes that no instance shows
    size_t sharedMeshes = 0;         ///< shown more than once
    size_t fineMeshes = 0;           ///< shown once, with a tree of their own because of the grid
    size_t movingMeshes = 0;         ///< with a tree of their own because an instance of theirs moves
    size_t asked = 0;                ///< meshes with a tree of their own because each is to have one

    bool hasUpperTree() const { return sharedMeshes + fineMeshes + movingMeshes + asked > 0; }
};

TreePlan planTrees(const Scene& scene, const TreePlanConfig& config);

/// Walks the scene's data once. `scene.environment` and the lights must be those that will be rendered.
/// Whether a light has a size, as a shape or as a disc in the sky.
bool hasShape(const Light& light);

SceneNeeds analyseNeeds(const Scene& scene, const TreePlanConfig& config = {});

}  // namespace raylab
