#include "engine/measure/image_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "engine/image/image_io.h"
#include "engine/image/srgb.h"
#include "image_test_support.h"

namespace raylab {
namespace {
using imagetest::errorOf;
using imagetest::randomBitmap;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Bitmap constant(int width, int height, int channels, float value) {
    Bitmap bitmap(width, height, channels);
    std::ranges::fill(bitmap.pixels, value);
    return bitmap;
}

Bitmap onePixel(float r, float g, float b) {
    Bitmap bitmap(1, 1, 3);
    bitmap.pixels = {r, g, b};
    return bitmap;
}

TEST(ImageError, EqualImages) {
    const Bitmap bitmap = randomBitmap(16, 9, 3, 1);
    const ImageError error = compareImages(bitmap, bitmap);
    EXPECT_EQ(error.mse, 0.0);
    EXPECT_EQ(error.relMse, 0.0);
    EXPECT_EQ(error.maxAbs, 0.0);
    EXPECT_EQ(error.psnr, std::numeric_limits<double>::infinity());
    EXPECT_EQ(error.pixels, 16u * 9u);
    EXPECT_EQ(error.nonFinite, 0u);
}

TEST(ImageError, WorkedByHand) {
    Bitmap image(2, 1, 3), reference(2, 1, 3);
    image.pixels = {1.0f, 0.5f, 0.0f, 2.0f, 0.0f, 0.25f};
    reference.pixels = {0.5f, 0.5f, 0.0f, 4.0f, 0.125f, 0.25f};
    const ImageError error = compareImages(image, reference);
    const double mse = (0.25 + 4.0 + 0.015625) / 6.0;
    EXPECT_NEAR(error.mse, mse, 1e-12);
    EXPECT_NEAR(error.rmse, std::sqrt(mse), 1e-12);
    EXPECT_NEAR(error.relMse, (0.25 / 0.26 + 4.0 / 16.01 + 0.015625 / 0.025625) / 6.0, 1e-12);
    EXPECT_EQ(error.maxAbs, 2.0);
    // Encoded: 1 against 0.7353570, and 0 against 0.3885728; 2 and 4 are both clamped to 1.
    const double displayMse = (std::pow(1.0 - 0.7353570, 2) + std::pow(0.3885728, 2)) / 6.0;
    EXPECT_NEAR(error.psnr, -10.0 * std::log10(displayMse), 1e-4);
}

TEST(ImageError, ReferenceValuesOfPsnr) {
    EXPECT_NEAR(compareImages(constant(3, 3, 3, 1.0f), constant(3, 3, 3, 0.0f)).psnr, 0.0, 1e-6);
    // One step of 255 throughout is 48.13 dB in 8-bit images.
    const Bitmap darker = constant(3, 3, 3, srgbToLinear(100.0f / 255.0f));
    const Bitmap lighter = constant(3, 3, 3, srgbToLinear(101.0f / 255.0f));
    EXPECT_NEAR(compareImages(lighter, darker).psnr, 48.1308, 1e-3);
}

TEST(ImageError, RelMseOfAScaledImageIsTheSquareOfTheRelativeError) {
    const Bitmap reference = constant(8, 8, 3, 1000.0f);
    EXPECT_NEAR(compareImages(constant(8, 8, 3, 1100.0f), reference).relMse, 0.01, 1e-7);
    EXPECT_NEAR(compareImages(constant(8, 8, 3, 0.1f), constant(8, 8, 3, 0.0f)).relMse, 1.0, 1e-6);
}

TEST(ImageError, NonFinitePixelsAreCountedAndLeftOut) {
    Bitmap image = constant(4, 1, 3, 1.0f), reference = constant(4, 1, 3, 0.5f);
    image.at(0, 0)[1] = std::nanf("");
    reference.at(1, 0)[2] = kInfinity;
    image.at(2, 0)[0] = kInfinity;
    reference.at(2, 0)[0] = kInfinity;
    const ImageError error = compareImages(image, reference);
    EXPECT_EQ(error.nonFinite, 3u);
    EXPECT_EQ(error.pixels, 1u);
    EXPECT_EQ(error.mse, 0.25);
    const ImageError none = compareImages(constant(2, 2, 3, kInfinity), constant(2, 2, 3, 0.0f));
    EXPECT_EQ(none.nonFinite, 4u);
    for (const double value : {none.mse, none.rmse, none.relMse, none.psnr, none.maxAbs})
        EXPECT_TRUE(std::isnan(value));
}

TEST(ImageError, AlphaIsLeftOut) {
    Bitmap image = constant(2, 2, 4, 0.5f);
    for (size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = std::nanf("");
    const ImageError error = compareImages(image, constant(2, 2, 3, 0.25f));
    EXPECT_EQ(error.mse, 0.0625);
    EXPECT_EQ(error.nonFinite, 0u);
}

TEST(ImageError, DifferentSizesAreNamed) {
    const std::string message = errorOf([] { compareImages(Bitmap(64, 48, 3), Bitmap(32, 33, 3)); });
    EXPECT_NE(message.find("64 x 48"), std::string::npos) << message;
    EXPECT_NE(message.find("32 x 33"), std::string::npos) << message;
    EXPECT_NE(errorOf([] { compareImages(Bitmap(4, 4, 3), Bitmap(4, 4, 1)); }), "");
    EXPECT_NE(errorOf([] { errorHeatMap(Bitmap(4, 4, 3), Bitmap(4, 5, 3)); }), "");
    EXPECT_NE(errorOf([] { zTest(Bitmap(4, 4, 3), Bitmap(4, 4, 3), Bitmap(4, 4, 3), Bitmap(4, 5, 3)); }), "");
}

/// CIE lightness of a linear sRGB colour, 0 to 100.
double lightness(const float* rgb) {
    const double y = 0.2126 * double{rgb[0]} + 0.7152 * double{rgb[1]} + 0.0722 * double{rgb[2]};
    return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

TEST(ImageErrorHeatMap, EndsAndNonFinite) {
    const Bitmap zero = onePixel(0.0f, 0.0f, 0.0f);
    EXPECT_EQ(errorHeatMap(zero, zero).pixels, (std::vector<float>{0.0f, 0.0f, 0.0f}));
    EXPECT_EQ(errorHeatMap(onePixel(5e-4f, 5e-4f, 5e-4f), zero).pixels, (std::vector<float>{0.0f, 0.0f, 0.0f}));
    EXPECT_GT(lightness(errorHeatMap(onePixel(9.0f, 9.0f, 9.0f), zero).pixels.data()), 98.0);
    EXPECT_EQ(errorHeatMap(onePixel(std::nanf(""), 0.0f, 0.0f), zero).pixels, (std::vector<float>{0.0f, 1.0f, 1.0f}));
    EXPECT_EQ(errorHeatMap(zero, onePixel(kInfinity, 0.0f, 0.0f)).pixels, (std::vector<float>{0.0f, 1.0f, 1.0f}));
}

TEST(ImageErrorHeatMap, LightnessGrowsEvenlyWithTheLogarithm) {
    double previous = -1e-9;
    for (int step = 0; step <= 120; ++step) {
        const double position = step / 120.0;
        const double relativeSquare = std::pow(10.0, -4.0 + 6.0 * position);
        const auto value = static_cast<float>(std::sqrt(relativeSquare * kRelMseEpsilon));  // over a black reference
        const Bitmap heat = errorHeatMap(onePixel(value, value, value), onePixel(0.0f, 0.0f, 0.0f));
        const double light = lightness(heat.pixels.data());
        EXPECT_NEAR(light, 100.0 * position, 3.5) << step;
        EXPECT_GT(light, previous) << step;
        previous = light;
    }
}

TEST(ImageErrorMask, OnlyPixelsThatCountAreMeasured) {
    Bitmap image = constant(3, 1, 3, 1.0f), reference = constant(3, 1, 3, 0.5f);
    image.at(0, 0)[0] = 9.0f;
    reference.at(2, 0)[1] = kInfinity;
    const PixelMask last = {0, 1, 0}, lastTwo = {0, 7, 1}, none = {0, 0, 0};
    EXPECT_EQ(compareImages(image, reference, last).mse, 0.25);
    EXPECT_EQ(compareImages(image, reference, last).nonFinite, 0u);
    EXPECT_EQ(compareImages(image, reference, last).maxAbs, 0.5);
    EXPECT_EQ(compareImages(image, reference, lastTwo).pixels, 1u);
    EXPECT_EQ(compareImages(image, reference, lastTwo).nonFinite, 1u);
    EXPECT_TRUE(std::isnan(compareImages(image, reference, none).mse));
    EXPECT_NE(errorOf([&] { compareImages(image, reference, PixelMask{1, 1}); }), "");
    EXPECT_NE(errorOf([&] { errorHeatMap(image, reference, PixelMask{1, 1}); }), "");
}

TEST(ImageErrorMask, HeatMapIsGreyWhereNothingCounts) {
    const Bitmap image = constant(2, 1, 3, 1.0f);
    const Bitmap heat = errorHeatMap(image, constant(2, 1, 3, 0.5f), PixelMask{0, 1});
    const float* grey = heat.at(0, 0);
    EXPECT_TRUE(grey[0] == grey[1] && grey[1] == grey[2] && grey[0] > 0.0f) << "black and white are on the scale";
    EXPECT_GT(heat.at(1, 0)[0], heat.at(1, 0)[2]) << "a relative square of 0.96 lies between red and orange";
}

TEST(ImageErrorMask, ZTestCorrectsForThePixelsThatCount) {
    const Bitmap one = constant(2, 2, 1, 1.0f);
    Bitmap image = one;
    *image.at(1, 0) = 1e6f;
    const ZTest masked = zTest(image, one, one, one, 0.01, PixelMask{1, 0, 0, 0});
    EXPECT_NEAR(masked.threshold, 2.575829303548901, 1e-12);  // of one test, as published
    EXPECT_EQ(masked.pixels, 1u);
    EXPECT_EQ(masked.significance, 0.01);
    EXPECT_TRUE(masked.passed);
    const ZTest all = zTest(image, one, one, one);
    EXPECT_EQ(all.passFraction, 0.75);
    EXPECT_FALSE(all.passed);
    EXPECT_NE(errorOf([&] { zTest(image, one, one, one, 0.01, PixelMask{0, 0, 0, 0}); }), "");
    EXPECT_NE(errorOf([&] { zTest(image, one, one, one, 0.01, PixelMask{1}); }), "");
}

TEST(ImageZTest, PublishedThresholds) {
    const Bitmap one = constant(1, 1, 1, 1.0f), three = constant(1, 1, 3, 1.0f), many = constant(48, 48, 3, 1.0f);
    EXPECT_NEAR(zTest(one, one, one, one, 0.05).threshold, 1.959963984540054, 1e-12);
    EXPECT_NEAR(zTest(one, one, one, one, 0.01).threshold, 2.575829303548901, 1e-12);
    // Sidak: quantiles of 1 - (1 - .01)^(1/n), from Python's statistics.NormalDist.
    EXPECT_NEAR(zTest(three, three, three, three).threshold, 2.9341610152639346, 1e-9);
    EXPECT_NEAR(zTest(many, many, many, many).threshold, 4.8174506211163965, 1e-9);
}

TEST(ImageZTest, DecidesAtTheThreshold) {
    const Bitmap reference = onePixel(0.0f, 0.0f, 0.0f), variance = onePixel(0.5f, 0.5f, 0.5f);
    const auto fraction = [&](float shift) {
        return zTest(onePixel(0.0f, shift, 0.0f), variance, reference, variance).passFraction;
    };
    EXPECT_EQ(fraction(2.934f), 1.0);
    EXPECT_EQ(fraction(2.935f), 0.0);
    EXPECT_EQ(fraction(-2.934f), 1.0);
    EXPECT_EQ(fraction(-2.935f), 0.0);
}

/// Two noisy images of the same mean image, `shift` standard errors apart, with the variances of their pixels.
struct NoisyPair {
    Bitmap image, imageVariance, reference, referenceVariance;

    NoisyPair(int size, uint32_t seed, float shift)
        : image(size, size, 3),
          imageVariance(size, size, 3),
          reference(size, size, 3),
          referenceVariance(size, size, 3) {
        std::mt19937 generator(seed);
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> uniform(0.01, 4.0);
        for (size_t i = 0; i < image.pixels.size(); ++i) {
            const double mean = uniform(generator), varianceA = uniform(generator), varianceB = uniform(generator);
            imageVariance.pixels[i] = static_cast<float>(varianceA);
            referenceVariance.pixels[i] = static_cast<float>(varianceB);
            image.pixels[i] = static_cast<float>(mean + std::sqrt(varianceA) * normal(generator) +
                                                 double{shift} * std::sqrt(varianceA + varianceB));
            reference.pixels[i] = static_cast<float>(mean + std::sqrt(varianceB) * normal(generator));
        }
    }
    ZTest test(double significance) const {
        return zTest(image, imageVariance, reference, referenceVariance, significance);
    }
};

TEST(ImageZTest, GaussianNoisePassesAsOftenAsPredicted) {
    // 1 - .95^192: each of the 192 tests of an 8 x 8 image fails with probability .05, so a pixel passes with .95^3.
    const double significance = -std::expm1(192.0 * std::log(0.95));
    constexpr uint32_t kImages = 400, kFirstSeed = 1000;
    double sum = 0.0;
    for (uint32_t i = 0; i < kImages; ++i) sum += NoisyPair(8, kFirstSeed + i, 0.0f).test(significance).passFraction;
    const double expected = std::pow(0.95, 3);
    const double sigma = std::sqrt(expected * (1.0 - expected) / (kImages * 64.0));
    EXPECT_NEAR(sum / kImages, expected, 4.0 * sigma) << "seeds from " << kFirstSeed;
}

TEST(ImageZTest, EqualMeansFailAnywhereAsOftenAsTheSignificanceSays) {
    constexpr uint32_t kImages = 1500, kFirstSeed = 5000;
    double failing = 0.0;
    for (uint32_t i = 0; i < kImages; ++i) failing += NoisyPair(6, kFirstSeed + i, 0.0f).test(0.2).passFraction < 1.0;
    const double sigma = std::sqrt(0.2 * 0.8 / kImages);
    EXPECT_NEAR(failing / kImages, 0.2, 4.0 * sigma) << "seeds from " << kFirstSeed;
}

TEST(ImageZTest, ShiftedImageFails) {
    EXPECT_GE(NoisyPair(64, 1, 0.0f).test(0.01).passFraction, 0.9975);
    EXPECT_LT(NoisyPair(64, 1, 3.0f).test(0.01).passFraction, 0.95);
    EXPECT_EQ(NoisyPair(64, 1, 20.0f).test(0.01).passFraction, 0.0);
}

TEST(ImageZTest, WithoutVarianceOnlyEqualValuesPass) {
    const Bitmap zero = constant(2, 1, 3, 0.0f), reference = constant(2, 1, 3, 0.7f);
    Bitmap image = reference;
    EXPECT_EQ(zTest(image, zero, reference, zero).passFraction, 1.0);
    image.at(1, 0)[2] = std::nextafter(0.7f, 1.0f);
    EXPECT_EQ(zTest(image, zero, reference, zero).passFraction, 0.5);
}

TEST(ImageZTest, WhatIsNoNumberOrNoVarianceFails) {
    const Bitmap fine = constant(1, 1, 3, 1.0f);
    for (const float value : {std::nanf(""), kInfinity}) {
        const Bitmap bad = onePixel(1.0f, value, 1.0f);
        EXPECT_EQ(zTest(bad, fine, fine, fine).passFraction, 0.0);
        EXPECT_EQ(zTest(fine, bad, fine, fine).passFraction, 0.0);
        EXPECT_EQ(zTest(bad, fine, bad, fine).passFraction, 0.0);
        EXPECT_EQ(zTest(fine, fine, fine, bad).passFraction, 0.0);
    }
    EXPECT_EQ(zTest(fine, fine, fine, onePixel(1.0f, -0.1f, 1.0f)).passFraction, 0.0);
    for (const double significance : {0.0, 1.0, -1.0, std::nan("")})
        EXPECT_NE(errorOf([&] { zTest(fine, fine, fine, fine, significance); }), "");
    EXPECT_NE(errorOf([] { zTest(Bitmap(), Bitmap(), Bitmap(), Bitmap()); }), "");
}

}  // namespace
}  // namespace raylab
