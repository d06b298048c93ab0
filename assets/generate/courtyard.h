#pragma once

#include "assets/generate/gltf_writer.h"

namespace raylab::assets {

/// The scene that greets a newcomer: a sunlit cloister about a reflecting pool with a marble Victory. Metres, Y up.
/// Every part is stored once and used by many nodes. The scene's `extras.raylab.sun` holds elevation and azimuth in
/// degrees (azimuth 0 is -Z and grows towards +X), turbidity, and a factor on the sky's radiance. Cameras: "courtyard"
/// (first), "statue", "arcade".
GltfWriter makeCourtyard();

}  // namespace raylab::assets
