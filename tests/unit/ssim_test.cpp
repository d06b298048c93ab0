#include "engine/measure/ssim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/image/srgb.h"
#include "engine/measure/image_pair.h"
#include "image_test_support.h"

namespace raylab {
namespace {
using imagetest::errorOf;
using imagetest::randomBitmap;

constexpr double kC1 = 1e-4, kC2 = 9e-4;  // (0.01)^2 and (0.03)^2, the paper's constants for a range of 1

/// An image whose sRGB-encoded value is encoded(x, y) in all channels.
Bitmap grey(int width, int height, const std::function<double(int, int)>& encoded) {
    Bitmap bitmap(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            std::fill_n(bitmap.at(x, y), 3, srgbToLinear(static_cast<float>(encoded(x, y))));
    return bitmap;
}

Bitmap constantGrey(double encoded) {
    return grey(16, 14, [=](int, int) { return encoded; });
}

TEST(Ssim, ImageAgainstItselfIsOneWhereAWindowFits) {
    const Bitmap bitmap = randomBitmap(20, 13, 3, 1);
    const Bitmap map = ssimMap(bitmap, bitmap);
    for (int y = 0; y < 13; ++y)
        for (int x = 0; x < 20; ++x) {
            const bool whole = x >= 5 && x < 15 && y >= 5 && y < 8;
            if (whole)
                EXPECT_EQ(*map.at(x, y), 1.0f);
            else
                EXPECT_TRUE(std::isnan(*map.at(x, y))) << x << " " << y;
        }
    EXPECT_EQ(meanOf(map), 1.0);
}

TEST(Ssim, ConstantImagesCompareTheirLuminances) {
    for (const auto& [a, b] : {std::pair(0.2, 0.7), {0.0, 1.0}, {0.5, 0.51}}) {
        const double expected = (2.0 * a * b + kC1) / (a * a + b * b + kC1);
        EXPECT_NEAR(meanOf(ssimMap(constantGrey(a), constantGrey(b))), expected, 2e-6) << a << " " << b;
    }
}

TEST(Ssim, ValuesBeyondTheDisplayAreClamped) {
    Bitmap bright(16, 16, 3), brighter(16, 16, 3);
    std::ranges::fill(bright.pixels, 1.0f);
    std::ranges::fill(brighter.pixels, 50.0f);
    EXPECT_EQ(meanOf(ssimMap(bright, brighter)), 1.0);
}

/// A checkerboard has the mean of its background in every window (the Gaussian's response at the highest frequency is
/// 1e-9), and the square of its amplitude as variance.
TEST(Ssim, ScaledContrastAndInvertedContrast) {
    constexpr double kMean = 0.5, kAmplitude = 0.1;
    const auto board = [&](double contrast) {
        return grey(24, 24, [=](int x, int y) { return kMean + contrast * kAmplitude * ((x + y) % 2 == 0 ? 1 : -1); });
    };
    for (const double contrast : {0.5, 0.1, 2.0, -1.0, 0.0}) {
        const double square = kAmplitude * kAmplitude;
        const double expected = (2.0 * contrast * square + kC2) / ((1.0 + contrast * contrast) * square + kC2);
        EXPECT_NEAR(meanOf(ssimMap(board(contrast), board(1.0))), expected, 2e-6) << contrast;
    }
}

/// Equation 13 of the paper as it stands, with a window of two dimensions and variances about the mean.
double directSsim(const Bitmap& a, const Bitmap& b, int centreX, int centreY, int channel) {
    const auto value = [&](const Bitmap& bitmap, int x, int y) {
        const double linear = std::clamp(double{bitmap.at(x, y)[channel]}, 0.0, 1.0);
        return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    };
    const auto weighted = [&](const std::function<double(int, int)>& term) {
        double sum = 0.0, weights = 0.0;
        for (int y = centreY - 5; y <= centreY + 5; ++y)
            for (int x = centreX - 5; x <= centreX + 5; ++x) {
                const double weight = std::exp(-(std::pow(x - centreX, 2) + std::pow(y - centreY, 2)) / (2.0 * 2.25));
                sum += weight * term(x, y);
                weights += weight;
            }
        return sum / weights;
    };
    const double meanA = weighted([&](int x, int y) { return value(a, x, y); });
    const double meanB = weighted([&](int x, int y) { return value(b, x, y); });
    const auto covariance = [&](const Bitmap& p, double meanP, const Bitmap& q, double meanQ) {
        return weighted([&](int x, int y) { return (value(p, x, y) - meanP) * (value(q, x, y) - meanQ); });
    };
    return (2.0 * meanA * meanB + kC1) * (2.0 * covariance(a, meanA, b, meanB) + kC2) /
           ((meanA * meanA + meanB * meanB + kC1) *
            (covariance(a, meanA, a, meanA) + covariance(b, meanB, b, meanB) + kC2));
}

TEST(Ssim, DirectSumOfThePaper) {
    const Bitmap a = randomBitmap(19, 15, 3, 11, 1.3f);
    Bitmap b = randomBitmap(19, 15, 3, 12, 1.3f);
    for (size_t i = 0; i < b.pixels.size(); ++i) b.pixels[i] = 0.7f * a.pixels[i] + 0.3f * b.pixels[i];
    const Bitmap map = ssimMap(a, b);
    for (int y = 5; y < 10; ++y)
        for (int x = 5; x < 14; ++x) {
            double expected = 0.0;
            for (int c = 0; c < 3; ++c) expected += directSsim(a, b, x, y, c) / 3.0;
            EXPECT_NEAR(*map.at(x, y), expected, 2e-6) << x << " " << y;
        }
}

TEST(Ssim, SymmetricAndSeesHue) {
    const Bitmap a = randomBitmap(18, 18, 3, 21), b = randomBitmap(18, 18, 3, 22);
    EXPECT_EQ(meanOf(ssimMap(a, b)), meanOf(ssimMap(b, a)));
    // One channel of three is black instead of white: two terms of 1 and one of C1 / (1 + C1).
    Bitmap white(16, 16, 3), yellow(16, 16, 3);
    std::ranges::fill(white.pixels, 1.0f);
    yellow.pixels = white.pixels;
    for (size_t i = 2; i < yellow.pixels.size(); i += 3) yellow.pixels[i] = 0.0f;
    EXPECT_NEAR(meanOf(ssimMap(white, yellow)), (2.0 + kC1 / (1.0 + kC1)) / 3.0, 1e-6);
}

TEST(Ssim, GreyAndAlphaCountAsColourDoes) {
    Bitmap single(16, 14, 1), alpha(16, 14, 4);
    std::ranges::fill(single.pixels, srgbToLinear(0.2f));
    Bitmap other = single;
    std::ranges::fill(other.pixels, srgbToLinear(0.7f));
    EXPECT_EQ(meanOf(ssimMap(single, other)), meanOf(ssimMap(constantGrey(0.2), constantGrey(0.7))));
    std::ranges::fill(alpha.pixels, srgbToLinear(0.2f));
    for (size_t i = 3; i < alpha.pixels.size(); i += 4) alpha.pixels[i] = std::nanf("");
    EXPECT_EQ(meanOf(ssimMap(alpha, constantGrey(0.2))), 1.0);
}

TEST(Ssim, WhatIsNotFiniteIsLeftOutAndHarmsNoNeighbour) {
    Bitmap a = randomBitmap(16, 16, 3, 31), b = a;
    a.at(8, 8)[1] = std::numeric_limits<float>::infinity();
    b.at(6, 7)[0] = std::nanf("");
    const Bitmap map = ssimMap(a, b);
    EXPECT_TRUE(std::isnan(*map.at(8, 8)));
    EXPECT_TRUE(std::isnan(*map.at(6, 7)));
    EXPECT_EQ(*map.at(7, 8), 1.0f);
    EXPECT_EQ(meanOf(map), 1.0);
}

TEST(Ssim, ImagesSmallerThanAWindowHaveNone) {
    EXPECT_TRUE(std::isnan(meanOf(ssimMap(Bitmap(10, 40, 3), Bitmap(10, 40, 3)))));
    EXPECT_TRUE(std::isnan(meanOf(ssimMap(Bitmap(), Bitmap()))));
    EXPECT_NE(errorOf([] { ssimMap(Bitmap(16, 16, 3), Bitmap(16, 17, 3)); }), "");
}

}  // namespace
}  // namespace raylab
