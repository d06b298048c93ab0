#pragma once

#include "engine/scene/scene.h"

namespace raylab {

/// Every other texel of the materials is a hole.
inline void cutOut(Scene& scene) {
    Texture texture;
    texture.width = texture.height = 8;
    for (uint32_t i = 0; i < 64; ++i) texture.texels.push_back((i + i / 8) % 2 == 0 ? 0xffffffffu : 0x00ffffffu);
    scene.textures = {texture};
    for (Material& material : scene.materials) {
        material.baseColorTexture = 0;
        material.alphaMode = AlphaMode::mask;
    }
    for (Mesh& mesh : scene.meshes) {
        mesh.uvs.resize(mesh.positions.size());
        for (size_t i = 0; i < mesh.uvs.size(); ++i) mesh.uvs[i] = {i % 3 == 1 ? 2.0f : 0.0f, i % 3 == 2 ? 2.0f : 0.0f};
    }
}

}  // namespace raylab
