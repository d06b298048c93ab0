#pragma once

#include <functional>

#include "engine/scene/import_texture.h"
#include "engine/scene/json_view.h"
#include "engine/scene/scene.h"

namespace raylab {

/// Requests the texture that an extension of a material names under a key; kNoTexture where it names none.
using TextureReader = std::function<int32_t(const JsonView& extension, const char* key, TextureRole role)>;

/// What few materials of a glTF file have: KHR_materials_{clearcoat, sheen, anisotropy}, the colour of
/// KHR_materials_specular, the attenuation of KHR_materials_volume, the textures of all of them and of
/// KHR_materials_transmission, and `extras.raylab.priority`. Throws Error for values of the wrong type.
void readGltfLobes(const JsonView& material, Material& result, const TextureReader& textureOf);

}  // namespace raylab
