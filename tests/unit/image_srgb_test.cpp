#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/image/srgb.h"

namespace raylab {
namespace {

/// IEC 61966-2-1 in double precision, written out a second time.
double linearOf(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

TEST(ImageSrgb, PublishedValues) {
    EXPECT_NEAR(srgbToLinear(0.5f), 0.21404114, 1e-7);
    EXPECT_NEAR(srgbToLinear(128.0f / 255.0f), 0.21586050, 1e-7);
    EXPECT_NEAR(linearToSrgb(0.5f), 0.73535698, 1e-6);
    EXPECT_NEAR(linearToSrgb(0.18f), 0.46135613, 1e-6);
    EXPECT_EQ(linearToSrgb8(0.5f), 188);
    EXPECT_EQ(linearToSrgb8(0.18f), 118);
    EXPECT_EQ(linearToSrgb8(1.0f), 255);
    EXPECT_EQ(linearToSrgb8(0.0f), 0);
}

TEST(ImageSrgb, PiecesMeet) {
    EXPECT_NEAR(srgbToLinear(0.04045f), srgbToLinear(std::nextafter(0.04045f, 1.0f)), 1e-7);
    EXPECT_NEAR(linearToSrgb(0.0031308f), linearToSrgb(std::nextafter(0.0031308f, 1.0f)), 1e-6);
}

TEST(ImageSrgb, EachByteComesBackAndOwnsHalfAStepAroundIt) {
    for (int byte = 0; byte < 256; ++byte) {
        EXPECT_EQ(linearToSrgb8(srgbToLinear(static_cast<float>(byte) / 255.0f)), byte);
        EXPECT_EQ(linearToSrgb8(static_cast<float>(linearOf((byte + 0.499) / 255.0))), byte);
        const double lower = std::max(byte - 0.499, 0.0);
        EXPECT_EQ(linearToSrgb8(static_cast<float>(linearOf(lower / 255.0))), byte);
    }
}

TEST(ImageSrgb, OutOfRange) {
    EXPECT_EQ(linearToSrgb8(-1.0f), 0);
    EXPECT_EQ(linearToSrgb8(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(linearToSrgb8(-std::numeric_limits<float>::infinity()), 0);
    EXPECT_EQ(linearToSrgb8(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(linearToSrgb8(7.0f), 255);
    EXPECT_EQ(quantize8(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(quantize8(0.5f), 128);
}

}  // namespace
}  // namespace raylab
