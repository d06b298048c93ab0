#pragma once

#include <vector>

#include "engine/render/film.h"
#include "shaders/shared/bindings.h"

namespace raylab {

/// How samples are given to blocks of 4 x 2 pixels after a pilot.
struct AdaptiveConfig {
    double samples = 64.0;     ///< a pixel on average
    double targetError = 0.0;  ///< relative error that each block should come to; 0: the best use of all samples
    double leastRate = 0.25;   ///< of the mean, in any block: the pilot may have missed what makes it noisy
    double mostRate = 16.0;    ///< of the mean
};

/// Samples of each block over `config.samples`, in the order of film/render_main.glsl: tile by tile, eight blocks a
/// tile. For the least sum of the blocks' relative variances, samples go in proportion to the deviation of one sample
/// (Neyman 1934); for a target error, in proportion to the variance. Deviations are those of 3 x 3 blocks together. The
/// mean over the image is 1, or less where the target needs less. Unbiased if the pilot's samples are not used again
/// and are independent of those that follow (Kirk, Arvo, "Unbiased Sampling Techniques for Image Synthesis", SIGGRAPH
/// 1991).
std::vector<float> sampleRates(const FilmImage& pilot, const AdaptiveConfig& config);

}  // namespace raylab
