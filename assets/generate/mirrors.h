#pragma once

#include "assets/generate/mesh_tools.h"
#include "engine/scene/scene.h"

namespace raylab::assets {

/// The second work's scene anew: a statue between two facing mirrors, under one point light, in a round of columns:
/// over 700,000 triangles. Its three shots are the cameras "statue", "between" and "corridor": past the mirrors, into
/// the statue's images, and along the row of images. Metres, Y up.
Scene makeMirrors(const Geometry& statue);

}  // namespace raylab::assets
