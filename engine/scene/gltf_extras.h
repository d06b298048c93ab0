#pragma once

#include <optional>

#include "engine/scene/gltf_document.h"
#include "engine/scene/scene.h"

namespace raylab {

/// `extras.raylab` of a part of the file. Other programs may store anything under `extras`: only an object counts.
std::optional<JsonView> raylabExtras(const JsonView& owner);

/// The same of the shown scene, or else of the whole file.
std::optional<JsonView> sceneExtras(const JsonView& root);

/// The number under `key`, or the fallback. Throws Error where it is out of range.
double numberBetween(const JsonView& owner, const char* key, double low, double high, double fallback);

/// What glTF has no place for, from `extras.raylab` of the shown scene, or else of the whole file:
///
///     "extras": {"raylab": {"environment": "sky.hdr", "environmentScale": 1.0,
///                           "sun": {"elevation": 45, "azimuth": 0, "turbidity": 2.5, "scale": 1}}}
///
/// Angles in degrees, see SkyDescription; the image is named relative to the file. An image that is missing or damaged
/// is a warning; non-finite or negative texels become 0 and are counted. Throws Error for values of the wrong type or
/// out of range.
void readGltfExtras(const GltfDocument& document, Scene& scene);

}  // namespace raylab
