#pragma once

#include <array>
#include <cstdint>

#include "engine/scene/scene.h"

namespace raylab {

/// Every texture index of a material, in the order in which files are read and written.
template <class M>
auto textureSlots(M& material) {
    auto& lobes = material.lobeTextures;
    return std::array{&material.baseColorTexture,
                      &material.metallicRoughnessTexture,
                      &material.normalTexture,
                      &material.emissionTexture,
                      &lobes.clearcoat,
                      &lobes.clearcoatRoughness,
                      &lobes.clearcoatNormal,
                      &lobes.sheenColor,
                      &lobes.sheenRoughness,
                      &lobes.anisotropy,
                      &lobes.specular,
                      &lobes.specularColor,
                      &lobes.transmission,
                      &lobes.thickness};
}

}  // namespace raylab
