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

/// How the tree over instances is laid out: meshes that are shown once are merged into one tree in world space, others
/// keep a tree of their own below an instance.
struct InstanceSharing {
    std::vector<uint32_t> useCount;  ///< instances by mesh
    size_t sharedMeshes = 0;         ///< meshes with more than one instance
};

InstanceSharing analyseSharing(const Scene& scene);

/// Walks the scene's data once. `scene.environment` and the lights must be those that will be rendered.
SceneNeeds analyseNeeds(const Scene& scene);

}  // namespace raylab
