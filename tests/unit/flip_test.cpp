#include "engine/measure/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/measure/image_pair.h"
#include "flip_direct.h"
#include "image_test_support.h"

namespace raylab {
namespace {
using imagetest::errorOf;
using imagetest::randomBitmap;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// (HyAB of green and blue after Hunt's adjustment)^0.7, as the authors' first CUDA program (2020) has it.
constexpr double kPublishedLargest = 41.2761;

Bitmap constant(int width, int height, std::array<float, 3> color) {
    Bitmap bitmap(width, height, 3);
    for (size_t i = 0; i < bitmap.pixels.size(); ++i) bitmap.pixels[i] = color[i % 3];
    return bitmap;
}

Bitmap constant(std::array<float, 3> color) { return constant(8, 5, color); }

Bitmap grey(float value) { return constant({value, value, value}); }

double meanFlip(const Bitmap& image, const Bitmap& reference) { return meanOf(flipMap(image, reference)); }

/// Smooth shapes, edges and noise of all colours, some beyond the display.
Bitmap pattern(int width, int height, uint32_t seed) {
    Bitmap bitmap = randomBitmap(width, height, 3, seed, 0.3f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            bitmap.at(x, y)[0] += x < width / 2 ? 0.1f : 0.8f;
            bitmap.at(x, y)[1] += 0.5f + 0.4f * std::sin(0.5f * static_cast<float>(y + x));
            bitmap.at(x, y)[2] += static_cast<float>(y) / static_cast<float>(height);
        }
    return bitmap;
}

TEST(Flip, EqualImagesDoNotDiffer) {
    const Bitmap bitmap = pattern(33, 21, 1);
    EXPECT_EQ(meanFlip(bitmap, bitmap), 0.0);
    EXPECT_EQ(meanOf(hdrFlipMap(bitmap, bitmap, hdrFlipExposures(bitmap))), 0.0);
}

TEST(Flip, SymmetricInItsArguments) {
    const Bitmap a = pattern(33, 21, 2), b = randomBitmap(33, 21, 3, 3);
    EXPECT_EQ(flipMap(a, b).pixels, flipMap(b, a).pixels);
}

TEST(Flip, GreenAgainstBlueIsTheLargest) {
    EXPECT_NEAR(meanFlip(constant({0, 1, 0}), constant({0, 0, 1})), 1.0, 1e-6);
    EXPECT_LT(meanFlip(constant({1, 0, 0}), constant({0, 0, 1})), 1.0);
    EXPECT_LT(meanFlip(constant({0, 1, 0}), constant({1, 0, 1})), 1.0);
}

/// Greys differ by their lightness alone, so the published maximum is all that a closed form needs.
TEST(Flip, GreysFromThePublishedMaximum) {
    const double knee = 0.4 * kPublishedLargest;
    const double blackAndWhite = 0.95 + 0.05 * (std::pow(100.0, 0.7) - knee) / (kPublishedLargest - knee);
    EXPECT_NEAR(meanFlip(grey(0.0f), grey(1.0f)), blackAndWhite, 1e-5);
    // Lightness 50 is a luminance of ((50 + 16) / 116)^3, lightness 10 is (26 / 116)^3.
    const float fifty = std::pow(66.0f / 116.0f, 3.0f), ten = std::pow(26.0f / 116.0f, 3.0f);
    EXPECT_NEAR(meanFlip(grey(fifty), grey(ten)), 0.95 * std::pow(40.0, 0.7) / knee, 1e-4);
    EXPECT_NEAR(meanFlip(grey(ten), grey(0.0f)), 0.95 * std::pow(10.0, 0.7) / knee, 1e-4);
}

/// Constant images have no features and pass the filters unchanged; primaries from their chromaticities (IEC 61966).
TEST(Flip, ConstantColoursInDoublePrecision) {
    const std::vector<std::array<float, 3>> colors = {{0.9f, 0.1f, 0.2f},  {0.0f, 0.5f, 1.0f}, {0.02f, 0.03f, 0.01f},
                                                      {0.6f, 0.55f, 0.5f}, {1.0f, 1.0f, 0.0f}, {0.001f, 0.0f, 0.2f}};
    for (size_t i = 0; i < colors.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            EXPECT_NEAR(meanFlip(constant(colors[i]), constant(colors[j])),
                        flipdirect::colorError(flipdirect::huntLab(flipdirect::xyzOf(colors[i])),
                                               flipdirect::huntLab(flipdirect::xyzOf(colors[j]))),
                        2e-4)
                << i << " " << j;
}

TEST(Flip, DirectSumsOfThePaper) {
    const Bitmap a = pattern(26, 19, 5);
    Bitmap b = pattern(26, 19, 6);
    for (int x = 4; x < 9; ++x) std::fill_n(b.at(x, 11), 3, 0.0f);
    for (const double pixelsPerDegree : {kFlipPixelsPerDegree, 25.0, kFlipLeastPixelsPerDegree}) {
        const Bitmap map = flipMap(a, b, pixelsPerDegree);
        const std::vector<double> expected = flipdirect::flip(a, b, pixelsPerDegree);
        for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(map.pixels[i], expected[i], 2e-4) << i;
    }
}

/// A step from black to white against a grey: beside the step the edge detector answers 1, since its taps of one sign
/// sum to 1, and the point detector less.
TEST(Flip, StepEdgeInClosedForm) {
    constexpr int kWide = 60, kStep = 30;
    Bitmap step(kWide, 9, 3);
    for (int y = 0; y < 9; ++y)
        for (int x = kStep; x < kWide; ++x) std::fill_n(step.at(x, y), 3, 1.0f);
    const double sigma = std::sqrt(0.0047 / 2.0) / std::numbers::pi * kFlipPixelsPerDegree;
    double all = 0.0, right = 0.0;
    for (int x = -10; x <= 10; ++x) {
        const double weight = std::exp(-0.5 * x * x / (sigma * sigma));
        all += weight;
        if (x >= 0) right += weight;
    }
    const auto lightness = [](double luminance) { return 116.0 * std::cbrt(luminance) - 16.0; };
    const double difference = std::abs(lightness(right / all) - lightness(0.3));
    const double color = 0.95 * std::pow(difference, 0.7) / (0.4 * kPublishedLargest);
    const double feature = std::sqrt(1.0 / std::numbers::sqrt2);
    const Bitmap map = flipMap(step, constant(kWide, 9, {0.3f, 0.3f, 0.3f}));
    EXPECT_NEAR(*map.at(kStep, 4), std::pow(color, 1.0 - feature), 1e-4);
}

TEST(Flip, OnePixelReachesAsFarAsTheFilters) {
    // 3 sigma of the blue-yellow filter: ceil(3 sqrt(.04 / 2) / pi * pixels per degree).
    for (const auto& [pixelsPerDegree, radius] : {std::pair(kFlipPixelsPerDegree, 10), {33.0, 5}}) {
        const Bitmap reference = constant(41, 41, {0.3f, 0.3f, 0.3f});
        Bitmap image = reference;
        image.at(20, 20)[2] = 1.0f;
        const Bitmap map = flipMap(image, reference, pixelsPerDegree);
        int reach = 0;
        for (int y = 0; y < 41; ++y)
            for (int x = 0; x < 41; ++x) {
                if (*map.at(x, y) > 0.0f) reach = std::max({reach, std::abs(x - 20), std::abs(y - 20)});
                EXPECT_NEAR(*map.at(x, y), *map.at(40 - x, y), 1e-3f);
                EXPECT_NEAR(*map.at(x, y), *map.at(y, x), 1e-3f);
            }
        EXPECT_EQ(reach, radius);
        EXPECT_EQ(*std::ranges::max_element(map.pixels), *map.at(20, 20));
    }
}

TEST(Flip, OutOfTheDisplaysRangeIsClamped) { EXPECT_EQ(meanFlip(constant({5, -1, 0}), constant({1, 0, 0})), 0.0); }

TEST(Flip, GreyBitmapsAndAlpha) {
    Bitmap one(8, 5, 1), other(8, 5, 1), alpha(8, 5, 4);
    std::ranges::fill(one.pixels, 0.5f);
    std::ranges::fill(other.pixels, 0.1f);
    EXPECT_EQ(meanFlip(one, other), meanFlip(grey(0.5f), grey(0.1f)));
    std::ranges::fill(alpha.pixels, 0.5f);
    EXPECT_EQ(meanFlip(alpha, grey(0.5f)), 0.0);
}

TEST(Flip, WhatIsNotFiniteIsLeftOutAndHarmsNoNeighbour) {
    Bitmap a = pattern(20, 20, 8), b = a;
    a.at(4, 4)[1] = kInfinity;
    b.at(12, 7)[0] = std::nanf("");
    for (const Bitmap& map : {flipMap(a, b), hdrFlipMap(a, b, hdrFlipExposures(b))}) {
        EXPECT_TRUE(std::isnan(*map.at(4, 4)));
        EXPECT_TRUE(std::isnan(*map.at(12, 7)));
        EXPECT_EQ(meanOf(map), 0.0);
    }
}

TEST(Flip, WhatCannotBeCompared) {
    const Bitmap bitmap = grey(0.5f);
    EXPECT_NE(errorOf([&] { flipMap(bitmap, Bitmap(8, 6, 3)); }), "");
    EXPECT_NE(errorOf([&] { hdrFlipMap(bitmap, Bitmap(8, 5, 1), {}); }), "");
    for (const double pixelsPerDegree : {0.0, -67.0, 0.5, 1e9, std::nan("")}) {
        EXPECT_NE(errorOf([&] { flipMap(bitmap, bitmap, pixelsPerDegree); }), "") << pixelsPerDegree;
        EXPECT_NE(errorOf([&] { hdrFlipMap(bitmap, bitmap, {}, pixelsPerDegree); }), "") << pixelsPerDegree;
    }
    EXPECT_EQ(meanOf(flipMap(bitmap, bitmap, kFlipLeastPixelsPerDegree)), 0.0);
    EXPECT_TRUE(std::isnan(meanOf(flipMap(Bitmap(), Bitmap()))));
}

double aces(double x) { return (0.9036 * x * x + 0.018 * x) / (0.8748 * x * x + 0.354 * x + 0.14); }

/// The luminance that the tone mapper takes to 0.85, by bisection.
double brightLuminance() {
    double low = 0.0, high = 10.0;
    for (int i = 0; i < 100; ++i) (aces(0.5 * (low + high)) < 0.85 ? low : high) = 0.5 * (low + high);
    return low;
}

/// The authors' example runs from -12.5423 to +0.9427 stops, in 14 exposures: here is an image that has its median and
/// its maximum.
TEST(HdrFlip, PublishedExposures) {
    const double bright = brightLuminance();
    Bitmap reference(5, 1, 1);
    const auto median = static_cast<float>(bright * std::exp2(-0.9427));
    reference.pixels = {0.0f, median, static_cast<float>(bright * std::exp2(12.5423)), median, 0.001f};
    const FlipExposures exposures = hdrFlipExposures(reference);
    EXPECT_NEAR(exposures.start, -12.5423, 1e-5);
    EXPECT_NEAR(exposures.stop, 0.9427, 1e-5);
    EXPECT_EQ(exposures.count, 14);
}

TEST(HdrFlip, ExposuresOfOddReferences) {
    const double bright = brightLuminance();
    Bitmap mostlyBlack(9, 1, 3);
    for (int x = 6; x < 9; ++x) std::fill_n(mostlyBlack.at(x, 0), 3, static_cast<float>(x));
    mostlyBlack.at(0, 0)[0] = -3.0f;
    mostlyBlack.at(1, 0)[1] = kInfinity;
    EXPECT_NEAR(hdrFlipExposures(mostlyBlack).start, std::log2(bright / 8.0), 1e-6);
    EXPECT_NEAR(hdrFlipExposures(mostlyBlack).stop, std::log2(bright / 7.0), 1e-6);
    EXPECT_EQ(hdrFlipExposures(mostlyBlack).count, 2);
    const FlipExposures black = hdrFlipExposures(grey(0.0f));
    EXPECT_EQ(black.start, 0.0);
    EXPECT_EQ(black.stop, 0.0);
    Bitmap even(4, 1, 1);
    even.pixels = {1.0f, 2.0f, 4.0f, 8.0f};
    EXPECT_NEAR(hdrFlipExposures(even).stop, std::log2(bright / 3.0), 1e-6);
    Bitmap endless(3, 1, 1);
    endless.pixels = {1e-38f, 1e-38f, 1e38f};
    EXPECT_EQ(hdrFlipExposures(endless).count, kFlipMostExposures);
}

TEST(HdrFlip, LargestOfTheToneMappedPictures) {
    Bitmap a = pattern(24, 18, 9), b = pattern(24, 18, 10);
    for (size_t i = 0; i < b.pixels.size(); ++i) b.pixels[i] = 0.5f * (a.pixels[i] + b.pixels[i]);
    std::fill_n(a.at(5, 5), 3, 3000.0f);
    std::fill_n(b.at(5, 5), 3, 900.0f);
    b.at(9, 9)[0] = -1.0f;
    const FlipExposures exposures = hdrFlipExposures(b);
    ASSERT_GT(exposures.count, 8);
    std::vector<float> expected(a.pixelCount(), 0.0f);
    for (int i = 0; i < exposures.count; ++i) {
        const double stops = exposures.start + (exposures.stop - exposures.start) * i / (exposures.count - 1);
        Bitmap toneMappedA = a, toneMappedB = b;
        for (Bitmap* bitmap : {&toneMappedA, &toneMappedB})
            for (float& value : bitmap->pixels)
                value = static_cast<float>(aces(std::max(0.0, std::exp2(stops) * double{value})));
        const Bitmap map = flipMap(toneMappedA, toneMappedB);
        for (size_t p = 0; p < expected.size(); ++p) expected[p] = std::max(expected[p], map.pixels[p]);
    }
    const Bitmap map = hdrFlipMap(a, b, exposures);
    for (size_t p = 0; p < expected.size(); ++p) EXPECT_NEAR(map.pixels[p], expected[p], 1e-4f) << p;
    EXPECT_GT(meanOf(map), 0.05);
}

TEST(HdrFlip, DoesNotDependOnTheUnitOfRadiance) {
    const Bitmap a = pattern(24, 18, 11), b = pattern(24, 18, 12);
    Bitmap scaledA = a, scaledB = b;
    for (float& value : scaledA.pixels) value *= 1024.0f;
    for (float& value : scaledB.pixels) value *= 1024.0f;
    const double mean = meanOf(hdrFlipMap(a, b, hdrFlipExposures(b)));
    EXPECT_GT(mean, 0.05);
    EXPECT_NEAR(meanOf(hdrFlipMap(scaledA, scaledB, hdrFlipExposures(scaledB))), mean, 1e-5);
}

}  // namespace
}  // namespace raylab
