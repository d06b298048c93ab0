#pragma once

#include "engine/scene/scene.h"

namespace raylab::assets {

/// A still life of surfaces of the second degree on a wooden table in the sun, each cut open by its clip planes so that
/// one looks into it, but for the two spheres, of glass and of silver. Metres, Y up, the table's top at 0.
Scene makeQuadrics();

}  // namespace raylab::assets
