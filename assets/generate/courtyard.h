#pragma once

#include "assets/generate/mesh_tools.h"
#include "engine/scene/scene.h"

namespace raylab::assets {

/// The scene that greets a newcomer: a sunlit cloister about a reflecting pool with a marble Victory, makeStatue(). Metres, Y up.
/// Every part is stored once and used by many instances. Cameras: "courtyard" (first), "statue", "arcade".
Scene makeCourtyard(const Geometry& statue);

}  // namespace raylab::assets
