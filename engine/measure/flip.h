#pragma once

#include <numbers>

#include "engine/image/bitmap.h"

namespace raylab {

/// FLIP: how much two images differ to someone who alternates between them, 0 to 1 in each pixel. A map of one channel;
/// the figure that is quoted is its mean (meanOf). Pixels that are not finite in either image are NaN and black to
/// their neighbours in both. Beyond the border the nearest pixel is repeated.

/// 3840 pixels over 0.7 m seen from 0.7 m away: the papers' setting, 67.02.
constexpr double kFlipPixelsPerDegree = 3840.0 * std::numbers::pi / 180.0;
constexpr double kFlipLeastPixelsPerDegree = 1.0;  ///< the filters lie within one pixel
constexpr double kFlipMostPixelsPerDegree = 1000.0;

/// LDR-FLIP: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for
/// Alternating Images", 2020. Takes values clamped to [0,1] as linear light of an sRGB display: the papers' encoding
/// and decoding cancel. Symmetric in its arguments. Throws Error where sizes differ, one is grey, or the pixels per
/// degree lie outside the range above.
Bitmap flipMap(const Bitmap& image, const Bitmap& reference, double pixelsPerDegree = kFlipPixelsPerDegree);

/// Exposures in stops, evenly spaced from `start` to `stop`.
struct FlipExposures {
    double start = 0.0;
    double stop = 0.0;
    int count = 2;
};

/// More than the 40 stops between starlight and the sun's disc; a wider range gets wider steps.
constexpr int kFlipMostExposures = 64;

/// Automatic exposures of HDR-FLIP (section 2.1 of its paper): the tone mapper takes the reference's largest luminance
/// to 0.85 at the start and its median to 0.85 at the stop; one exposure a stop, at least 2. The paper leaves open a
/// median of 0: then it is the median of what is not black; an all-black reference gets exposure 0.
FlipExposures hdrFlipExposures(const Bitmap& reference);

/// HDR-FLIP: Andersson, Nilsson, Shirley, Akenine-Moller, "Visualizing Errors in Rendered High Dynamic Range Images",
/// 2021: the largest LDR-FLIP of a pixel over all exposures, tone mapped by the ACES fit that the paper uses. Negative
/// values are black. Throws as flipMap does.
Bitmap hdrFlipMap(const Bitmap& image, const Bitmap& reference, const FlipExposures& exposures,
                  double pixelsPerDegree = kFlipPixelsPerDegree);

}  // namespace raylab
