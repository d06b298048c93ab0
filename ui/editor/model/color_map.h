#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>

namespace raylab::editor {

/// Ways to show a number as a colour. All are made in Oklab (Ottosson, "A perceptual color space for image
/// processing", 2020), with an even lightness, and cut to what a display has:
/// - heat: lightness 0.12 to 0.98, hue from violet through red to yellow: more is brighter;
/// - sequential: lightness 0.25 to 0.93, hue from blue through green to yellow: readable by the colour-blind;
/// - diverging: from blue through a light grey in the middle to red: about a half;
/// - grey: lightness 0.15 to 1.
enum class ColorMap { heat, sequential, diverging, grey };

struct ColorMapInfo {
    ColorMap map;
    std::string_view name;
};
inline constexpr std::array kColorMaps = {
    ColorMapInfo{ColorMap::heat, "heat"},
    ColorMapInfo{ColorMap::sequential, "sequential"},
    ColorMapInfo{ColorMap::diverging, "diverging"},
    ColorMapInfo{ColorMap::grey, "grey"},
};

/// Of a value of 0 .. 1, clamped; as the display wants it (sRGB), components in 0 .. 1.
glm::vec3 mapColor(ColorMap map, double value);

/// One of many colours of the same lightness, neighbours a golden angle of hue apart.
glm::vec3 categoryColor(uint32_t index);

/// R in the lowest byte, opaque.
uint32_t packColor(const glm::vec3& color);

}  // namespace raylab::editor
