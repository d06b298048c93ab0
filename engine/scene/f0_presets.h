#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "engine/scene/scene.h"

namespace raylab {

/// Reflectance of a substance at normal incidence, linear: the second work's table (design: methods.md, section 2).
struct F0Preset {
    std::string_view name;
    glm::vec3 f0;
    bool isMetal;
};

std::span<const F0Preset> f0Presets();

/// Throws Error that lists the names where there is none of that name.
const F0Preset& findF0Preset(std::string_view name);

/// Index of refraction of a dielectric that reflects `f0`, below 1, at normal incidence from air: the n above 1 of
/// f0 = ((n - 1) / (n + 1))^2.
float iorOfF0(float f0);

/// A metal of the preset's colour, or an opaque dielectric over `body`, its diffuse colour.
Material presetMaterial(const F0Preset& preset, float roughness, glm::vec3 body = glm::vec3(0.8f));

}  // namespace raylab
