#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "engine/scene/json_view.h"
#include "engine/scene/scene.h"

namespace raylab {

/// What few materials of a glTF file have: KHR_materials_{clearcoat, sheen, anisotropy}, the colour of
/// KHR_materials_specular, the attenuation of KHR_materials_volume, and `extras.raylab.priority`. Textures of these
/// extensions are not read and counted in `unread`, by what they are. Throws Error for values of the wrong type.
void readGltfLobes(const JsonView& material, Material& result, std::map<std::string, size_t>& unread);

}  // namespace raylab
