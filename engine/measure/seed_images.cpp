#include "engine/measure/seed_images.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/measure/image_error.h"

namespace raylab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Bitmap toBitmap(const std::vector<double>& values, int width, int height, int channels, double scale) {
    Bitmap bitmap(width, height, channels);
    std::ranges::transform(values, bitmap.pixels.begin(),
                           [&](double value) { return static_cast<float>(value * scale); });
    return bitmap;
}

/// What one channel of one pixel adds to the sums.
struct ChannelEstimate {
    double biasSquared = 0.0;
    double ofNoise = 0.0;  ///< its variance without any bias
    double ofBias = 0.0;   ///< what bias adds to that; an estimate that may be negative, unlike its sum
};

/// Plug-ins for b^2 s^2 and s^4 that are unbiased for normal values, and too large for heavy tails.
ChannelEstimate estimateChannel(double difference, double variance, double referenceVariance, double images,
                                int parts) {
    const double ofMean = variance / images;
    const double biasSquared = difference * difference - ofMean - referenceVariance;
    const double fourth = variance * variance * (images - 1.0) / (images + 1.0);
    const double biasTimesVariance =
        difference * difference * variance - fourth / images - referenceVariance * variance;
    const double ofReference =
        2.0 * referenceVariance * referenceVariance * (parts > 1 ? 1.0 + 1.0 / (parts - 1.0) : 1.0);
    return {biasSquared, 2.0 * fourth / (images * (images - 1.0)) + 4.0 * referenceVariance * ofMean + ofReference,
            4.0 * biasTimesVariance / images + 4.0 * biasSquared * referenceVariance};
}

}  // namespace

Bitmap errorWeights(const Bitmap& reference, bool relative) {
    const int channels = colorChannels(reference);
    Bitmap weights(reference.width, reference.height, channels);
    for (size_t pixel = 0; pixel < reference.pixelCount(); ++pixel) {
        const float* value = reference.pixels.data() + pixel * static_cast<size_t>(reference.channels);
        if (!isFinite(value, channels)) continue;
        for (int c = 0; c < channels; ++c) {
            const double square = double{value[c]} * double{value[c]};
            weights.pixels[pixel * static_cast<size_t>(channels) + static_cast<size_t>(c)] =
                relative ? static_cast<float>(1.0 / (square + kRelMseEpsilon)) : 1.0f;
        }
    }
    return weights;
}

double referenceNoise(const ReferenceImage& reference, const Bitmap& weights) {
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < weights.pixels.size(); ++i) {
        if (weights.pixels[i] == 0.0f) continue;
        sum += double{weights.pixels[i]} * double{reference.varianceOfMean.pixels[i]};
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

SeedImages::SeedImages(int width, int height, int channels)
    : width_(width),
      height_(height),
      channels_(channels),
      mean_(static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels)),
      squares_(mean_.size()) {}

SeedImages::SeedImages(const Bitmap& mean, const Bitmap& variance, uint32_t count)
    : SeedImages(mean.width, mean.height, mean.channels) {
    requireSameShape(mean, variance);
    count_ = count;
    std::ranges::copy(mean.pixels, mean_.begin());
    if (count > 1)
        std::ranges::transform(variance.pixels, squares_.begin(), [&](float v) { return double{v} * (count - 1.0); });
}

void SeedImages::add(const Bitmap& image) {
    if (image.width != width_ || image.height != height_ || image.channels != channels_)
        throw Error("images of one chart differ in size", ExitCode::internalError);
    ++count_;
    for (size_t i = 0; i < mean_.size(); ++i) {
        const double value = std::isfinite(image.pixels[i]) ? double{image.pixels[i]} : 0.0;
        const double before = value - mean_[i];
        mean_[i] += before / count_;
        squares_[i] += before * (value - mean_[i]);
    }
}

Bitmap SeedImages::mean() const { return toBitmap(mean_, width_, height_, channels_, 1.0); }

Bitmap SeedImages::variance() const {
    return toBitmap(squares_, width_, height_, channels_, count_ > 1 ? 1.0 / (count_ - 1.0) : 0.0);
}

BiasEstimate SeedImages::estimate(const ReferenceImage& reference, const Bitmap& weights) const {
    if (count_ < 2) return {kNaN, kNaN, kNaN};
    requireSameShape(reference.mean, weights);
    if (weights.width != width_ || weights.height != height_ || weights.channels != channels_)
        throw Error("the reference has another size than the images", ExitCode::internalError);
    const double images = count_;
    double bias = 0.0, ofNoise = 0.0, ofBias = 0.0, variance = 0.0;
    size_t counted = 0;
    for (size_t i = 0; i < mean_.size(); ++i) {
        const double weight = double{weights.pixels[i]};
        if (weight == 0.0) continue;
        const size_t inReference = i / static_cast<size_t>(channels_) * static_cast<size_t>(reference.mean.channels) +
                                   i % static_cast<size_t>(channels_);
        const double spread = squares_[i] / (images - 1.0);
        const ChannelEstimate channel =
            estimateChannel(mean_[i] - double{reference.mean.pixels[inReference]}, spread,
                            double{reference.varianceOfMean.pixels[i]}, images, reference.parts);
        bias += weight * channel.biasSquared;
        ofNoise += weight * weight * channel.ofNoise;
        ofBias += weight * weight * channel.ofBias;
        variance += weight * spread;
        ++counted;
    }
    if (counted == 0) return {kNaN, kNaN, kNaN};
    const double n = static_cast<double>(counted);
    return {bias / n, std::sqrt((ofNoise + std::max(0.0, ofBias)) * channels_) / n, variance / n};
}

}  // namespace raylab
