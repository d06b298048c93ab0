#pragma once

#include <optional>
#include <vector>

#include "engine/scene/gltf_document.h"
#include "engine/scene/scene.h"

namespace raylab {

/// One entry of the quadrics of a file.
struct GltfQuadrics {
    Mesh mesh;  ///< its material is not set
    std::optional<size_t> material;
};

/// Quadrics, which glTF has no place for, from `extras.raylab` of the whole file:
///
///     "extras": {"raylab": {"quadrics": [{"name": "bowl", "material": 0, "surfaces": [
///         {"kind": "paraboloid", "radii": [1, 1, 1], "clip": [0, 1]},
///         {"kind": "sphere", "radius": 0.5}]}]}}
///
/// See Quadric for the kinds; "sphere" is an ellipsoid of equal radii. Radii are 1 where they are missing. `clip` may
/// be missing for ellipsoids, which are closed then. Throws Error, naming the place, for a wrong type, an unknown kind,
/// a radius that is not positive, clip planes that leave nothing, a number beyond 1e18.
std::vector<GltfQuadrics> readGltfQuadrics(const GltfDocument& document);

/// The entry that a node shows: `"extras": {"raylab": {"quadrics": INDEX}}`. Throws Error where there is no such entry.
std::optional<size_t> quadricsOfNode(const JsonView& node, size_t entryCount);

}  // namespace raylab
