#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "ui/editor/context.h"

namespace raylab {

/// What panels tell scripts, by name: where things were drawn (the centre of each, in ImGui's coordinates), and
/// numbers.
struct Places {
    std::map<std::string, std::pair<float, float>> centres;
    std::map<std::string, double> values;
};

/// Names the item that was drawn last.
void notePlace(EditorContext& context, const std::string& name);
/// Names a point.
void notePlace(EditorContext& context, const std::string& name, float x, float y);
/// Names a number.
void noteValue(EditorContext& context, const std::string& name, double value);

/// Where the item of that name was last; nothing where it was never drawn.
std::optional<std::pair<float, float>> findPlace(EditorContext& context, const std::string& name);

}  // namespace raylab
