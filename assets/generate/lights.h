#pragma once

#include "engine/scene/scene.h"

namespace raylab::assets {

constexpr uint32_t kLightCount = 10000;

/// A village around a bay on a moonlit night, lit by kLightCount small emissive bits: windows, street lanterns, and
/// paper lanterns that float on the water. Metres, Y up, the water at 0.
Scene makeLights();

}  // namespace raylab::assets
