#pragma once

#include "engine/scene/scene.h"

namespace raylab::assets {

/// The scene that greets a newcomer: a sunlit cloister about a reflecting pool with a marble Victory. Metres, Y up.
/// Every part is stored once and used by many instances. Cameras: "courtyard" (first), "statue", "arcade".
Scene makeCourtyard();

}  // namespace raylab::assets
