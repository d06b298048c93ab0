#pragma once

#include "ui/editor/model/document.h"

/// Edits of punctual lights. Indices count Scene::lights and exist.
namespace raylab::editor {

/// The new light is selected.
Edit addLight(Light light);

/// `what` names the part that changes; a drag gives all its edits one `mergeKey`. Intensities below 0 count as 0, cones
/// are taken into 0 <= inner <= outer <= 90 degrees, the direction is made a unit vector (straight down where it is 0).
Edit setLight(uint32_t index, Light light, const std::string& what, std::string mergeKey = {});

/// The copy is selected.
Edit duplicateLight(uint32_t index);
Edit deleteLight(uint32_t index);

/// The light with the colour of a black body at as much luminance as it has.
Light withTemperature(Light light, double kelvin);

/// "point", "directional", "spot".
const char* lightKindName(LightKind kind);
/// Unit of its intensity: "W/sr" or "W/m2".
const char* lightUnit(LightKind kind);

}  // namespace raylab::editor
