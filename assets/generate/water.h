#pragma once

#include "engine/scene/scene.h"

namespace raylab::assets {

/// A round bath under a dome with one lamp: all light on the floor of the pool comes through the waves, as caustics, and
/// leaves through them again. Cameras above, below and straight down.
Scene makeWater();

}  // namespace raylab::assets
