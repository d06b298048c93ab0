#include "ui/editor/mesh_box.h"

#include <array>
#include <map>

namespace raylab {
namespace {

constexpr size_t kMostBoxes = 4096;

/// Of a mesh as long as it lives: where its primitives are, and how many.
using Key = std::array<uintptr_t, 3>;

Key keyOf(const Mesh& mesh) {
    if (!mesh.quadrics.empty()) return {reinterpret_cast<uintptr_t>(mesh.quadrics.data()), mesh.quadrics.size(), 0};
    return {reinterpret_cast<uintptr_t>(mesh.positions.data()), mesh.positions.size(), mesh.triangles.size()};
}

}  // namespace

const Bounds& meshBox(const Scene& scene, uint32_t mesh) {
    static std::map<Key, Bounds> boxes;
    const Key key = keyOf(scene.meshes[mesh]);
    if (const auto found = boxes.find(key); found != boxes.end()) return found->second;
    if (boxes.size() >= kMostBoxes) boxes.clear();
    Scene alone;
    alone.meshes.shared() = {scene.meshes.shared()[mesh]};
    alone.instances = {Instance{}};
    return boxes[key] = sceneBounds(alone);
}

}  // namespace raylab
