#include "engine/image/image8.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "engine/core/file.h"
#include "engine/image/image_io.h"

namespace raylab {
namespace {

/// The 8 bits that are shown are those that writePng() would write.
TEST(Image8, ShowsWhatAPngFileHolds) {
    for (const int channels : {1, 3}) {
        Bitmap bitmap(19, 7, channels);
        for (size_t i = 0; i < bitmap.pixels.size(); ++i)
            bitmap.pixels[i] = -0.1f + 1.3f * static_cast<float>(i) / static_cast<float>(bitmap.pixels.size());
        const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                           ("raylab-image8-" + std::to_string(channels) + ".png");
        writePng(path, bitmap);
        std::string whyNot;
        const auto read = decodeImage8(readFile(path), whyNot);
        std::filesystem::remove(path);
        ASSERT_TRUE(read) << whyNot;
        const Image8 shown = encodeSrgb8(bitmap);
        EXPECT_EQ(shown.width, 19u);
        EXPECT_EQ(shown.height, 7u);
        EXPECT_EQ(shown.texels, read->texels);
    }
}

}  // namespace
}  // namespace raylab
