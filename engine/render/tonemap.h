#pragma once

#include <string>
#include <vector>

#include "engine/image/bitmap.h"

namespace raylab {

std::vector<std::string> tonemapNames();

/// Display-referred linear image in [0,1]: radiance times 2^exposure through the curve of that name, alpha as it is.
/// Throws Error where there is no such curve.
Bitmap tonemapImage(const Bitmap& radiance, double exposureStops, const std::string& curve);

}  // namespace raylab
