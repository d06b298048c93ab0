#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/image/bitmap.h"
#include "engine/image/image_io.h"

namespace raylab {

/// A film as raylab render writes it to an EXR file.
struct FilmPart {
    std::string name;  ///< for messages
    Bitmap mean;
    Bitmap variance;  ///< of one sample
    Bitmap samples;   ///< one channel
    Metadata metadata;
};

/// Of a denoised one, the film before. Throws Error, naming the file, where it is no EXR with the layers variance and
/// samples.
FilmPart readFilmPart(const std::string& path);

/// The film of all samples: means and variances are pooled pairwise without cancellation (Chan, Golub, LeVeque,
/// "Updating Formulae and a Pairwise Algorithm for Computing Sample Variances", 1979), in double precision. The
/// metadata are the first one's, with "spp" and "samples" summed, all seeds under "seed", and the number of files under
/// "merged-parts". Throws Error, naming the files and what differs: sizes, settings other than those that leave the
/// estimated image as it is, or scenes; and where two share a seed, for then their samples are the same.
FilmPart mergeFilms(std::span<const FilmPart> parts);

}  // namespace raylab
