#include <algorithm>
#include <cmath>

#include "engine/render/gpu_data.h"

namespace raylab {
namespace {

/// Black leaves less than what floats hold of light: a coefficient that is as good as infinite, and finite.
constexpr float kSmallestTransmittance = 1e-30f;

/// Coefficient of Beer's law, of which attenuationColor = exp(-coefficient x attenuationDistance).
glm::vec3 absorption(const Material& m) {
    const glm::vec3 left = glm::clamp(m.attenuationColor, glm::vec3(kSmallestTransmittance), glm::vec3(1.0f));
    return std::isfinite(m.attenuationDistance) ? -glm::log(left) / m.attenuationDistance : glm::vec3(0.0f);
}

shared::LobeData packLobe(const Material& m) {
    shared::LobeData data{};
    data.specularColor = m.specularColor;
    data.clearcoat = m.clearcoat;
    data.clearcoatAlpha = m.clearcoatRoughness * m.clearcoatRoughness;
    data.sheenColor = m.sheenColor;
    data.sheenRoughness = m.sheenRoughness;
    data.absorption = absorption(m);
    data.anisotropy = m.anisotropy;
    data.tangentCos = std::cos(m.anisotropyRotationRadians);
    data.tangentSin = std::sin(m.anisotropyRotationRadians);
    data.priority = m.priority;
    return data;
}

shared::LobeTextureData packTextures(const LobeTextures& t) {
    shared::LobeTextureData data{};
    data.clearcoat = textureIndex(t.clearcoat);
    data.clearcoatRoughness = textureIndex(t.clearcoatRoughness);
    data.clearcoatNormal = textureIndex(t.clearcoatNormal);
    data.clearcoatNormalScale = t.clearcoatNormalScale;
    data.sheenColor = textureIndex(t.sheenColor);
    data.sheenRoughness = textureIndex(t.sheenRoughness);
    data.anisotropy = textureIndex(t.anisotropy);
    data.specular = textureIndex(t.specular);
    data.specularColor = textureIndex(t.specularColor);
    data.transmission = textureIndex(t.transmission);
    return data;
}

}  // namespace

std::vector<shared::LobeTextureData> packLobeTextures(const Scene& scene) {
    std::vector<shared::LobeTextureData> packed;
    for (const Material& material : scene.materials) packed.push_back(packTextures(material.lobeTextures));
    return packed;
}

std::vector<shared::LobeData> packLobes(const Scene& scene) {
    std::vector<shared::LobeData> packed;
    for (const Material& material : scene.materials) packed.push_back(packLobe(material));
    return packed;
}

}  // namespace raylab
