#pragma once

#include "engine/image/bitmap.h"
#include "engine/render/film.h"
#include "ui/editor/render_request.h"

namespace raylab {

/// A film as the display wants it: by exposure and tonemap, or as it is where the integrator shows a view. Pixels
/// without a sample are taken from `backdrop`, an earlier mean of any size, bilinearly; where that is empty they are black.
Picture developPicture(const FilmImage& film, const Bitmap& backdrop, const RenderSettings& settings,
                       float sceneDiagonal);

/// What a mean looks like on a display: linear values in [0,1], as writePng() takes them.
Bitmap displayImage(Bitmap mean, const RenderSettings& settings, float sceneDiagonal);

}  // namespace raylab
