#pragma once

#include "engine/render/film.h"

namespace raylab {

/// How two renderings of the same size differ: maps of one channel, and figures. All throw Error where sizes differ.

/// Mean of |a-b| over the channels, in radiance.
Bitmap absoluteDifference(const Bitmap& a, const Bitmap& b);

/// Root of the mean over the channels of (a-b)^2 / (b^2 + kRelMseEpsilon), as in ImageError::relMse.
Bitmap relativeDifference(const Bitmap& a, const Bitmap& b);

/// Largest of the channels' |a-b| in standard errors of the difference, whose variance is that of both means: what the
/// test of Subr and Arvo (zTest) looks at. 0 where the values are equal, infinite where they are not and neither has a
/// variance.
Bitmap zScores(const FilmImage& a, const FilmImage& b);

/// sqrt(relMse) that the film's own noise makes it differ by from what it converges to, by its variance.
double relativeNoise(const FilmImage& film);

}  // namespace raylab
