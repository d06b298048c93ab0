#include "engine/measure/image_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "image_test_support.h"

namespace raylab {
namespace {
using imagetest::errorOf;

Bitmap row(std::vector<float> values, int channels) {
    Bitmap bitmap(static_cast<int>(values.size()) / channels, 1, channels);
    bitmap.pixels = std::move(values);
    return bitmap;
}

TEST(ImagePair, MaskTakesWhatIsNotBlackAndIgnoresAlpha) {
    EXPECT_EQ(maskOf(row({0, 0, 0, 0, 0, 0.1f, 1, 1, 1}, 3)), (PixelMask{0, 1, 1}));
    EXPECT_EQ(maskOf(row({0, 0, 0, 1, 0, -1, 0, 0}, 4)), (PixelMask{0, 1}));
    EXPECT_EQ(maskOf(row({0, 0.5f}, 1)), (PixelMask{0, 1}));
}

TEST(ImagePair, CropTakesTheRectangle) {
    Bitmap bitmap(5, 4, 3);
    for (size_t i = 0; i < bitmap.pixels.size(); ++i) bitmap.pixels[i] = static_cast<float>(i);
    const Bitmap part = cropped(bitmap, {3, 1, 2, 3});
    ASSERT_EQ(part.width, 2);
    ASSERT_EQ(part.height, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 2; ++x)
            for (int c = 0; c < 3; ++c) EXPECT_EQ(part.at(x, y)[c], static_cast<float>(((y + 1) * 5 + x + 3) * 3 + c));
    EXPECT_EQ(cropped(bitmap, {0, 0, 5, 4}).pixels, bitmap.pixels);
}

TEST(ImagePair, CropsOutsideOrEmptyAreRefused) {
    const Bitmap bitmap(5, 4, 3);
    constexpr int kLargest = std::numeric_limits<int>::max();
    for (const PixelRect& rect :
         {PixelRect{4, 0, 2, 1}, {0, 3, 1, 2}, {-1, 0, 2, 2}, {0, -1, 2, 2}, {5, 0, 1, 1}, {kLargest, 0, kLargest, 1}})
        EXPECT_NE(errorOf([&] { cropped(bitmap, rect); }).find("beyond the image of 5 x 4"), std::string::npos);
    for (const PixelRect& rect : {PixelRect{0, 0, 0, 1}, {0, 0, 1, 0}, {0, 0, -2, 1}})
        EXPECT_NE(errorOf([&] { cropped(bitmap, rect); }).find("empty"), std::string::npos);
}

TEST(ImagePair, MeansLeaveOutMaskAndNaN) {
    const float nan = std::nanf("");
    const Bitmap map = row({1, 2, nan, 9}, 1);
    EXPECT_EQ(meanOf(map), 4.0);
    EXPECT_EQ(meanOf(map, PixelMask{1, 1, 1, 0}), 1.5);
    EXPECT_TRUE(std::isnan(meanOf(map, PixelMask{0, 0, 1, 0})));
    EXPECT_TRUE(std::isnan(meanOf(Bitmap(0, 0, 1))));
    EXPECT_NE(errorOf([&] { meanOf(map, PixelMask{1, 1}); }).find("2 pixels"), std::string::npos);
}

TEST(ImagePair, NonFinitePixelsOfEither) {
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    const Bitmap a = row({0, 0, nan, 1, 1, 1, 1, 1, 1}, 3), b = row({0, 0, 0, 1, 1, 1, -infinity, 0, 0}, 3);
    EXPECT_EQ(nonFinitePixels(a, b), (PixelMask{1, 0, 1}));
}

TEST(ImagePair, HeatPictureSpansItsRange) {
    const Bitmap picture = heatPicture(row({2, 4, -7, 99, std::nanf(""), 3}, 1), 2.0, 4.0, PixelMask{1, 1, 1, 1, 1, 0});
    const auto pixel = [&](int x) { return std::vector<float>(picture.at(x, 0), picture.at(x, 0) + 3); };
    EXPECT_EQ(pixel(0), (std::vector<float>{0, 0, 0}));
    EXPECT_EQ(pixel(2), pixel(0));
    EXPECT_EQ(pixel(3), pixel(1));
    EXPECT_GT(pixel(1)[2], 0.6f);
    EXPECT_EQ(pixel(4), (std::vector<float>{0, 1, 1}));
    EXPECT_EQ(pixel(5)[0], pixel(5)[2]);
    EXPECT_NE(errorOf([] { heatPicture(Bitmap(3, 1, 1), 0.0, 1.0, PixelMask{1}); }), "");
}

}  // namespace
}  // namespace raylab
