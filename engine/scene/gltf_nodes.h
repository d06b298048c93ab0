#pragma once

#include <vector>

#include "engine/scene/gltf_document.h"
#include "engine/scene/scene.h"

namespace raylab {

/// A node of the scene that is shown, its transform composed in double precision. A node with two parents is placed
/// twice.
struct PlacedNode {
    size_t node = 0;
    glm::dmat4 toWorld{1.0};
    glm::dmat4 endToWorld{1.0};  ///< where the shutter closes
};

/// The nodes of the default scene, parents before children; without any scene, all that have no parent and what is
/// below them. Where the file says when the shutter opens and closes (readShutter), its first animation moves them; and
/// `extras.raylab.endMatrix` of a node is its transform where the shutter closes. Cameras and lights are those of the moment
/// when it opens. The document must be valid (no cycles). Throws Error where shared children would be placed more than a
/// million times.
std::vector<PlacedNode> placeNodes(const GltfDocument& document);

/// The node transform of a camera: it looks along -Z, +Y is up, no scale.
glm::dmat4 cameraToWorld(const Camera& camera);

/// Perspective cameras; orthographic ones are left out with a warning. `extras.raylab` of a camera may hold its exact
/// `target` and `up`, of which the node's matrix says the direction alone; where the node has been turned or moved
/// since, the matrix counts.
void readGltfCameras(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Scene& scene);

/// KHR_lights_punctual. A light shines along the node's -Z; intensities are taken as they are (candela, lux).
void readGltfLights(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Scene& scene);

}  // namespace raylab
