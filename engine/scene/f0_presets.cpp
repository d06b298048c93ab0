#include "engine/scene/f0_presets.h"

#include <array>
#include <cmath>
#include <string>

#include "engine/core/error.h"

namespace raylab {
namespace {

constexpr F0Preset dielectric(std::string_view name, float f0) { return {name, glm::vec3(f0), false}; }
constexpr F0Preset metal(std::string_view name, glm::vec3 f0) { return {name, f0, true}; }

constexpr std::array kPresets = {
    dielectric("water", 0.02f),
    dielectric("plastic", 0.03f),
    dielectric("glass (low)", 0.03f),
    dielectric("plastic (high)", 0.05f),
    dielectric("glass (high)", 0.08f),
    dielectric("ruby", 0.08f),
    dielectric("diamond", 0.17f),
    metal("iron", {0.56f, 0.57f, 0.58f}),
    metal("copper", {0.95f, 0.64f, 0.54f}),
    metal("gold", {1.0f, 0.71f, 0.29f}),
    metal("aluminium", {0.91f, 0.92f, 0.92f}),
    metal("silver", {0.95f, 0.93f, 0.88f}),
};

}  // namespace

std::span<const F0Preset> f0Presets() { return kPresets; }

const F0Preset& findF0Preset(std::string_view name) {
    std::string names;
    for (const F0Preset& preset : kPresets) {
        if (preset.name == name) return preset;
        names += (names.empty() ? "" : ", ") + std::string(preset.name);
    }
    throw Error("there is no preset '" + std::string(name) + "'; there are " + names);
}

float iorOfF0(float f0) {
    const float root = std::sqrt(f0);
    return (1.0f + root) / (1.0f - root);
}

Material presetMaterial(const F0Preset& preset, float roughness, glm::vec3 body) {
    Material material{.name = std::string(preset.name), .roughness = roughness};
    material.baseColor = preset.isMetal ? preset.f0 : body;
    material.metallic = preset.isMetal ? 1.0f : 0.0f;
    if (!preset.isMetal) material.ior = iorOfF0(preset.f0.x);
    return material;
}

}  // namespace raylab
