#pragma once

#include "engine/scene/scene.h"

namespace raylab::assets {

/// A ball, a quadric, of each preset of f0Presets() and of glass, plaster and rough metals, on four steps in a studio:
/// what light passes through, opaque dielectrics, metals, and a ball of each lobe that few materials have. Spot lights stand in the middle of the soft boxes that path
/// tracing sees. Metres, Y up.
Scene makeMaterials();

}  // namespace raylab::assets
