#include "engine/measure/seed_images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/core/error.h"

namespace raylab {
namespace {

constexpr int kSize = 16;

Bitmap constantImage(float value) {
    Bitmap image(kSize, kSize, 3);
    for (float& channel : image.pixels) channel = value;
    return image;
}

Bitmap noisy(const Bitmap& mean, double deviation, std::mt19937& random) {
    std::normal_distribution<double> noise(0.0, deviation);
    Bitmap image = mean;
    for (float& value : image.pixels) value += static_cast<float>(noise(random));
    return image;
}

ReferenceImage exact(const Bitmap& mean) { return {mean, Bitmap(kSize, kSize, 3), 0}; }

TEST(SeedImages, MeanAndVarianceAreThoseOfTheImages) {
    SeedImages images(1, 1, 1);
    for (const float value : {1.0f, 4.0f, 7.0f}) {
        Bitmap image(1, 1, 1);
        image.pixels[0] = value;
        images.add(image);
    }
    EXPECT_FLOAT_EQ(images.mean().pixels[0], 4.0f);
    EXPECT_FLOAT_EQ(images.variance().pixels[0], 9.0f);
    const SeedImages again(images.mean(), images.variance(), images.count());
    EXPECT_FLOAT_EQ(again.variance().pixels[0], 9.0f);
    // Against 3: (4-3)^2 - 9/3.
    Bitmap reference(1, 1, 1), weight(1, 1, 1);
    reference.pixels[0] = 3.0f;
    weight.pixels[0] = 1.0f;
    const BiasEstimate estimate = again.estimate({reference, Bitmap(1, 1, 1), 0}, weight);
    EXPECT_NEAR(estimate.biasSquared, -2.0, 1e-6);
    EXPECT_NEAR(estimate.variance, 9.0, 1e-6);
}

TEST(SeedImages, OneImageSaysNothingOfBias) {
    SeedImages images(kSize, kSize, 3);
    images.add(constantImage(1.0f));
    EXPECT_TRUE(
        std::isnan(images.estimate(exact(constantImage(1.0f)), errorWeights(constantImage(1.0f), false)).biasSquared));
    EXPECT_THROW(images.add(Bitmap(2, 2, 3)), Error);
}

TEST(SeedImages, WeightsAreRelativeWhereAskedAndLeaveOutWhatIsNotFinite) {
    Bitmap reference = constantImage(2.0f);
    reference.at(3, 0)[1] = INFINITY;
    const Bitmap relative = errorWeights(reference, true), plain = errorWeights(reference, false);
    EXPECT_FLOAT_EQ(relative.at(0, 0)[0], 1.0f / 4.01f);
    EXPECT_EQ(plain.at(0, 0)[0], 1.0f);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(plain.at(3, 0)[c], 0.0f);
}

struct Simulation {
    double bias;  ///< of half of the pixels; the others have none
    int images;
    double referenceDeviation;
    int referenceParts;
};

/// Means of the estimate and its error over repetitions, and how often |estimate - truth| is within two errors.
struct Outcome {
    double mean = 0.0, meanError = 0.0, deviation = 0.0, within = 0.0;
};

constexpr int kRepetitions = 400;
constexpr double kDeviation = 0.5;

Outcome simulate(const Simulation& s, std::mt19937& random) {
    const Bitmap truth = constantImage(1.0f);
    Bitmap biased = truth;
    for (size_t i = 0; i < biased.pixels.size() / 2; ++i) biased.pixels[i] += static_cast<float>(s.bias);
    const double exactBias = 0.5 * s.bias * s.bias;
    const Bitmap weights = errorWeights(truth, false);
    Outcome outcome;
    double squares = 0.0;
    for (int i = 0; i < kRepetitions; ++i) {
        ReferenceImage reference = exact(truth);
        if (s.referenceParts > 0) {
            SeedImages parts(kSize, kSize, 3);
            for (int part = 0; part < s.referenceParts; ++part)
                parts.add(noisy(truth, s.referenceDeviation * std::sqrt(s.referenceParts), random));
            reference = {parts.mean(), parts.variance(), s.referenceParts};
            for (float& value : reference.varianceOfMean.pixels) value /= static_cast<float>(s.referenceParts);
        }
        SeedImages images(kSize, kSize, 3);
        for (int k = 0; k < s.images; ++k) images.add(noisy(biased, kDeviation, random));
        const BiasEstimate estimate = images.estimate(reference, weights);
        outcome.mean += estimate.biasSquared / kRepetitions;
        outcome.meanError += estimate.standardError / kRepetitions;
        squares += std::pow(estimate.biasSquared - exactBias, 2.0) / kRepetitions;
        outcome.within +=
            std::abs(estimate.biasSquared - exactBias) <= 2.0 * estimate.standardError ? 1.0 / kRepetitions : 0.0;
    }
    outcome.deviation = std::sqrt(squares);
    return outcome;
}

/// Noise of deviation .5 on 768 independent values: the mean estimate is right within 4 standard errors of the
/// repetitions, and the estimated error is an upper bound of the true one that is off by the three channels taken for
/// dependent at most, sqrt(3).
TEST(SeedImages, BiasOfSyntheticImagesIsFoundWithAnHonestError) {
    std::mt19937 random(20261122);
    for (const Simulation& s : {Simulation{0.0, 4, 0.0, 0}, Simulation{0.1, 4, 0.0, 0}, Simulation{0.5, 2, 0.0, 0},
                                Simulation{0.0, 8, 0.2, 4}, Simulation{0.2, 4, 0.2, 4}}) {
        const Outcome outcome = simulate(s, random);
        const double exactBias = 0.5 * s.bias * s.bias;
        EXPECT_NEAR(outcome.mean, exactBias, 4.0 * outcome.deviation / std::sqrt(double{kRepetitions}))
            << s.bias << ", " << s.images << " images";
        EXPECT_GT(outcome.meanError, outcome.deviation);
        EXPECT_LT(outcome.meanError, outcome.deviation * std::sqrt(3.0) * 1.15);
        EXPECT_GT(outcome.within, 0.97);
    }
}

TEST(SeedImages, ReferenceNoiseIsItsMeanVariance) {
    ReferenceImage reference = exact(constantImage(2.0f));
    for (float& value : reference.varianceOfMean.pixels) value = 0.01f;
    EXPECT_NEAR(referenceNoise(reference, errorWeights(reference.mean, false)), 0.01, 1e-7);
    EXPECT_NEAR(referenceNoise(reference, errorWeights(reference.mean, true)), 0.01 / 4.01, 1e-7);
}

}  // namespace
}  // namespace raylab
