#include "engine/measure/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "engine/image/image_io.h"
#include "tests/support/scratch_folder.h"

namespace raylab {
namespace {

Bitmap constant(int channels, float value) {
    Bitmap bitmap(4, 3, channels);
    std::ranges::fill(bitmap.pixels, value);
    return bitmap;
}

/// A denoiser's bias is no truth: the rendering before it is.
TEST(Reference, OfADenoisedPictureIsTheOneBefore) {
    const support::ScratchFolder folder;
    const std::filesystem::path file = folder.path() / "denoised.exr";
    writeExr(file, std::array{Layer{"", constant(3, 5.0f)}, Layer{"raw", constant(3, 1.0f)},
                              Layer{"raw-variance", constant(3, 0.5f)}, Layer{"samples", constant(1, 8.0f)}});
    const Reference reference = readReference(file, 4, 3);
    EXPECT_EQ(reference.image.mean.pixels, constant(3, 1.0f).pixels);
    EXPECT_EQ(reference.image.varianceOfMean.pixels, constant(3, 0.0625f).pixels);
    EXPECT_EQ(reference.samples, 8u);
}

}  // namespace
}  // namespace raylab
