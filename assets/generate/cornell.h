#pragma once

#include "engine/scene/scene.h"

namespace raylab::assets {

/// The Cornell box as measured by the Cornell University Program of Computer Graphics ("Cornell Box Data"): coordinates
/// in millimetres, verbatim, one unit = 1 mm. The camera looks along +z, so x grows to the left of the picture: the red
/// wall is on the left. Two departures: the ceiling is cut out where the light is, since the published rectangles lie
/// in one plane; and spectra become linear sRGB as told in spectra.h. The light's radiance keeps the published numbers
/// (0, 8, 15.6, 18.4 at 400, 500, 600, 700 nm; unit unspecified there, so only ratios mean something).
Scene makeCornellBox();

}  // namespace raylab::assets
