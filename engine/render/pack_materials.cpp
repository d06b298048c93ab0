#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>

#include "engine/core/error.h"
#include "engine/image/srgb.h"
#include "engine/render/gpu_data.h"

namespace raylab {
namespace {

uint32_t levelCount(uint32_t width, uint32_t height) { return static_cast<uint32_t>(std::bit_width(std::max(width, height))); }

uint64_t texelCount(uint32_t width, uint32_t height) {
    uint64_t total = 0;
    for (uint32_t level = levelCount(width, height); level > 0; --level) {
        total += static_cast<uint64_t>(width) * height;
        width = std::max(width / 2, 1u);
        height = std::max(height / 2, 1u);
    }
    return total;
}

const std::array<float, 256>& srgbDecodeTable() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (size_t i = 0; i < values.size(); ++i) values[i] = srgbToLinear(static_cast<float>(i) / 255.0f);
        return values;
    }();
    return table;
}

glm::vec4 decode(uint32_t texel, bool srgb) {
    const std::array<uint32_t, 4> bytes = {texel & 255u, texel >> 8 & 255u, texel >> 16 & 255u, texel >> 24};
    const auto channel = [&](size_t i) {
        return srgb && i < 3 ? srgbDecodeTable()[bytes[i]] : static_cast<float>(bytes[i]) / 255.0f;
    };
    return {channel(0), channel(1), channel(2), channel(3)};
}

uint32_t encode(glm::vec4 value, bool srgb) {
    uint32_t texel = 0;
    for (int i = 0; i < 4; ++i) {
        const uint8_t byte = srgb && i < 3 ? linearToSrgb8(value[i]) : quantize8(value[i]);
        texel |= static_cast<uint32_t>(byte) << (8 * i);
    }
    return texel;
}

/// Half the size by 2 x 2 means in linear light; the last row or column of an odd size is left out.
void halve(const uint32_t* from, uint32_t width, uint32_t height, uint32_t* to, bool srgb) {
    const uint32_t w = std::max(width / 2, 1u), h = std::max(height / 2, 1u);
    for (uint32_t y = 0; y < h; ++y)
        for (uint32_t x = 0; x < w; ++x) {
            const uint32_t x0 = std::min(2 * x, width - 1), x1 = std::min(2 * x + 1, width - 1);
            const uint32_t y0 = std::min(2 * y, height - 1) * width, y1 = std::min(2 * y + 1, height - 1) * width;
            const glm::vec4 sum = decode(from[y0 + x0], srgb) + decode(from[y0 + x1], srgb) +
                                  decode(from[y1 + x0], srgb) + decode(from[y1 + x1], srgb);
            to[y * w + x] = encode(sum * 0.25f, srgb);
        }
}

void fillLevels(const Texture& texture, uint32_t* to) {
    std::copy(texture.texels.begin(), texture.texels.end(), to);
    uint32_t width = texture.width, height = texture.height;
    for (uint32_t level = 1; level < levelCount(texture.width, texture.height); ++level) {
        uint32_t* next = to + static_cast<size_t>(width) * height;
        halve(to, width, height, next, texture.srgb);
        to = next;
        width = std::max(width / 2, 1u);
        height = std::max(height / 2, 1u);
    }
}

uint32_t textureFlags(const Texture& texture) {
    return static_cast<uint32_t>(texture.wrapU) | static_cast<uint32_t>(texture.wrapV) << 2 |
           (texture.srgb ? shared::kTextureSrgb : 0u) |
           levelCount(texture.width, texture.height) << shared::kTextureLevelShift;
}

void packTextures(const Scene& scene, MaterialTables& tables) {
    uint64_t total = 0;
    for (const Texture& texture : scene.textures) {
        tables.textures.push_back({static_cast<uint32_t>(total), texture.width, texture.height, textureFlags(texture)});
        total += texelCount(texture.width, texture.height);
        if (total > INT32_MAX) throw Error(scene.name + ": its textures have more than 2^31 texels; make them smaller");
    }
    tables.texels.resize(total);
    tbb::parallel_for(size_t{0}, scene.textures.size(), [&](size_t i) {
        fillLevels(scene.textures[i], tables.texels.data() + tables.textures[i].firstTexel);
    });
    for (size_t i = 0; i < tables.textures.size(); ++i) {
        const size_t end = i + 1 < tables.textures.size() ? tables.textures[i + 1].firstTexel : tables.texels.size();
        tables.means.push_back(end > tables.textures[i].firstTexel ? tables.texels[end - 1] : 0u);
    }
}

shared::MaterialData packMaterial(const Material& m) {
    shared::MaterialData data{};
    data.baseColor = m.baseColor;
    data.alpha = m.alpha;
    data.emission = m.emission;
    data.alphaCutoff = m.alphaMode == AlphaMode::blend ? shared::kAlphaBlend : m.alphaCutoff;
    data.metallic = m.metallic;
    data.roughness = m.roughness;
    data.transmission = m.transmission;
    data.ior = m.ior;
    data.specular = m.specular;
    data.normalScale = m.normalScale;
    data.flags = (m.doubleSided ? shared::kMaterialDoubleSided : 0u) | (m.thin ? shared::kMaterialThin : 0u);
    data.baseColorTexture = textureIndex(m.baseColorTexture);
    data.metallicRoughnessTexture = textureIndex(m.metallicRoughnessTexture);
    data.normalTexture = textureIndex(m.normalTexture);
    data.emissionTexture = textureIndex(m.emissionTexture);
    return data;
}

}  // namespace

uint32_t textureIndex(int32_t texture) {
    return texture == kNoTexture ? shared::kNoTextureIndex : static_cast<uint32_t>(texture);
}

std::vector<shared::MaterialData> packMaterialData(const Scene& scene) {
    std::vector<shared::MaterialData> packed;
    for (const Material& material : scene.materials) packed.push_back(packMaterial(material));
    return packed;
}

MaterialTables packMaterials(const Scene& scene) {
    MaterialTables tables;
    tables.materials = packMaterialData(scene);
    packTextures(scene, tables);
    return tables;
}

}  // namespace raylab
