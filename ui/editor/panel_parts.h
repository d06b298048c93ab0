#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ui/editor/model/color_map.h"

struct ImGuiTextFilter;

namespace raylab {

// Small parts that panels have in common, drawn into the current ImGui window.

/// A slider with two ends over lowest .. highest, as wide as there is room. True where either has moved; lo <= hi.
bool rangeSlider(const char* id, uint32_t& lo, uint32_t& hi, uint32_t lowest, uint32_t highest);

/// A line of the map's colours from left to right, with what its ends mean below.
void colorBar(editor::ColorMap map, const std::string& low, const std::string& high);

/// A choice among the colour maps. True where it was made.
bool colorMapCombo(const char* id, editor::ColorMap& map);

/// Bars of a histogram, each with the number it stands for (or begins with, `step` from the next) and its count in a
/// tooltip.
void histogram(const char* id, std::span<const uint32_t> counts, const char* what, uint32_t step = 1);

/// A field as wide as there is room, which says what is typed there as long as it is empty.
void searchField(const char* id, ImGuiTextFilter& filter, const char* hint);

/// 12345 as "12,345".
std::string countText(size_t count);

/// With three significant digits.
std::string figureText(double value);

/// Text in the dim colour behind the item drawn last, at the right edge.
void rightText(const std::string& text);

/// Text in the dim colour, wrapped at the window's edge.
void dimText(const std::string& text);

}  // namespace raylab
