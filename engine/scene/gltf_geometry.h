#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_document.h"
#include "engine/scene/gltf_nodes.h"

namespace raylab {

/// A triangle primitive of a glTF mesh.
struct GltfPart {
    size_t mesh = 0;
    std::string name;
    std::optional<size_t> material;
};

/// The geometry of a document in the plainest glTF there is: one mesh a part (named by its index), float attributes, no
/// images, materials, skins or sparse accessors. Texture coordinates are (u, 0, v): of three components Assimp turns the
/// second one upside down, 1 - v, which rounds. Assimp 5.2.5 misreads integer texture coordinates, refuses interleaved
/// views without trailing padding, and crashes on some damaged extras; none of these reach it. From 5.3 on it numbers
/// vertices anew, so all that belongs to one goes through it.
struct PlainGltf {
    std::vector<GltfPart> parts;
    std::string json;
    std::vector<std::byte> unrolled;  ///< buffer "unrolled": accessors that had to be converted
};

/// Parts of the meshes that `nodes` show. `uvSets[m]` is the texture coordinate set that material m reads.
/// Says in `warnings` what was left out: points, lines, bad indices, vertex colours, skins, morph targets.
PlainGltf plainGeometry(const GltfDocument& document, std::span<const PlacedNode> nodes, std::span<const size_t> uvSets,
                        std::vector<std::string>& warnings);

}  // namespace raylab
