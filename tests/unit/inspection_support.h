#pragma once

#include <glm/gtc/matrix_transform.hpp>

#include "engine/measure/tree_inspection.h"
#include "tests/support/scene_build.h"

namespace raylab::inspection_test {

constexpr uint32_t kSeed = 20261122;

inline const TraceConfig kMeshTrees{.trees = Trees::mesh};

inline Scene soupScene(size_t triangles) {
    Scene scene;
    const uint32_t material = support::addMaterial(scene, support::lambert(0.5f));
    support::addMesh(scene, support::meshOf(accel_test::randomSoup(triangles, 0.1f, kSeed), material));
    return scene;
}

/// Two meshes, turned, stretched and moved, several times each.
inline Scene instanceScene() {
    Scene scene;
    const uint32_t material = support::addMaterial(scene, support::lambert(0.5f));
    accel_test::Random random(kSeed + 1);
    const auto place = [&] {
        const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1.0f), random.inCube(-1.5f, 1.5f)),
                                             random.uniform(0.0f, 6.0f), random.direction());
        return glm::scale(turned, random.inCube(0.5f, 1.5f));
    };
    for (const uint32_t seed : {kSeed + 2, kSeed + 3}) {
        const uint32_t mesh =
            support::addMesh(scene, support::meshOf(accel_test::randomSoup(200, 0.2f, seed), material), place());
        for (int i = 0; i < 5; ++i) support::addInstance(scene, mesh, place());
    }
    return scene;
}

/// Every node with every placement, from the root.
inline std::vector<TreeNode> allNodes(const TreeInspection& trees) {
    std::vector<TreeNode> nodes{trees.root()};
    for (size_t i = 0; i < nodes.size(); ++i) {
        const std::vector<TreeNode> below = trees.children(nodes[i]);
        nodes.insert(nodes.end(), below.begin(), below.end());
    }
    return nodes;
}

}  // namespace raylab::inspection_test
