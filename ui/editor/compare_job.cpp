#include "ui/editor/compare_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/luminance.h"
#include "engine/image/srgb.h"
#include "engine/measure/difference_map.h"
#include "engine/measure/flip.h"
#include "engine/measure/image_error.h"
#include "engine/measure/image_pair.h"

namespace raylab {
namespace {

constexpr std::array kModes = {
    CompareModeInfo{CompareMode::off, "off", "A alone; B rests"},
    CompareModeInfo{CompareMode::wipe, "wipe", "A left of a line that one drags, B right of it"},
    CompareModeInfo{CompareMode::checker, "checker", "A and B in squares"},
    CompareModeInfo{CompareMode::blink, "blink", "A and B by turns"},
    CompareModeInfo{CompareMode::sideBySide, "side by side", "both, at half the size"},
    CompareModeInfo{CompareMode::absolute, "absolute", "Mean |A - B| of the channels, in radiance"},
    CompareModeInfo{CompareMode::relative, "relative", "sqrt of mean (A - B)^2 / (B^2 + 0.01), as in relMSE"},
    CompareModeInfo{CompareMode::flip, "FLIP", "LDR-FLIP of both as displayed: what one sees when they alternate"},
    CompareModeInfo{CompareMode::zScore, "Z-score", "|A - B| in standard errors of both: beyond 3 is rarely noise"},
    CompareModeInfo{CompareMode::firstHit, "first hit", "Pixels whose middle ray meets another thing in A than in B"},
};

/// Standard errors that one channel in 370 exceeds by chance.
constexpr float kLargeZ = 3.0f;

std::string percentText(const char* name, double part) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%s %.3g %%", name, 100.0 * part);
    return text.data();
}

std::string numberText(const char* name, double value) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%s %.4g", name, value);
    return text.data();
}

uint32_t texelOf(const float* linear) {
    return uint32_t{linearToSrgb8(linear[0])} | uint32_t{linearToSrgb8(linear[1])} << 8 |
           uint32_t{linearToSrgb8(linear[2])} << 16 | 0xff000000u;
}

/// What a display shows, in linear light.
Bitmap displayed(const Picture& picture) {
    Bitmap bitmap(static_cast<int>(picture.width), static_cast<int>(picture.height), 3);
    for (size_t i = 0; i < picture.texels.size(); ++i)
        for (uint32_t c = 0; c < 3; ++c)
            bitmap.pixels[3 * i + c] = srgbToLinear(static_cast<float>(picture.texels[i] >> (8 * c) & 255u) / 255.0f);
    return bitmap;
}

void showHeat(Bitmap map, CompareResult& result) {
    const HeatScale scale = heatScaleOf(result.mode);
    double low = scale.low, high = scale.high;
    if (scale.isLogarithmic) {
        low = std::log10(low);
        high = std::log10(high);
        for (float& value : map.pixels)
            value = value > 0.0f ? std::log10(value) : -std::numeric_limits<float>::infinity();
    }
    const Bitmap heat = heatPicture(map, low, high);
    for (size_t i = 0; i < result.texels.size(); ++i) result.texels[i] = texelOf(heat.pixels.data() + 3 * i);
}

void compareZ(const CompareInput& input, CompareResult& result) {
    const Bitmap map = zScores(*input.a->film, *input.b->film);
    const auto large = std::ranges::count_if(map.pixels, [](float z) { return z > kLargeZ; });
    result.figureValue = static_cast<double>(large) / static_cast<double>(map.pixelCount());
    result.figure = percentText("beyond 3 standard errors:", result.figureValue);
    showHeat(map, result);
}

/// A, dim and grey, with red where B meets another thing.
void compareHits(const CompareInput& input, CompareResult& result) {
    const HitMap* a = input.a->hits.get();
    const HitMap* b = input.b->hits.get();
    if (a == nullptr || b == nullptr || a->hits.size() != b->hits.size()) {
        result.mismatch = "waiting for the first hits";
        return;
    }
    constexpr float kDim = 0.35f;
    constexpr uint32_t kRed = 0xff3c3cffu;
    const Bitmap picture = displayed(*input.a);
    size_t others = 0;
    for (size_t i = 0; i < result.texels.size(); ++i) {
        const float* p = picture.pixels.data() + 3 * i;
        const float grey = kDim * static_cast<float>(luminance(p));
        const bool isOther = !(a->hits[i] == b->hits[i]);
        others += isOther ? 1 : 0;
        const std::array<float, 3> dim = {grey, grey, grey};
        result.texels[i] = isOther ? kRed : texelOf(dim.data());
    }
    result.figureValue = static_cast<double>(others) / static_cast<double>(result.texels.size());
    result.figure = percentText("other first hits:", result.figureValue);
}

void compareMeans(const CompareInput& input, CompareResult& result) {
    const Bitmap &a = input.a->film->picture(), &b = input.b->film->picture();
    if (input.mode == CompareMode::absolute) {
        const Bitmap map = absoluteDifference(a, b);
        result.figureValue = meanOf(map);
        result.figure = numberText("mean |A - B|", result.figureValue);
        showHeat(map, result);
    } else {
        result.figureValue = std::sqrt(compareImages(a, b).relMse);
        result.figure = percentText("sqrt(relMSE)", result.figureValue);
        showHeat(relativeDifference(a, b), result);
    }
}

void showDifference(const CompareInput& input, CompareResult& result) {
    result.texels.resize(size_t{result.width} * result.height);
    if (input.mode == CompareMode::zScore) {
        compareZ(input, result);
    } else if (input.mode == CompareMode::firstHit) {
        compareHits(input, result);
    } else if (input.mode == CompareMode::flip) {
        const Bitmap map = flipMap(displayed(*input.a), displayed(*input.b));
        result.figureValue = meanOf(map);
        result.figure = numberText("mean FLIP", result.figureValue);
        showHeat(map, result);
    } else {
        compareMeans(input, result);
    }
    if (!result.mismatch.empty()) result.texels.clear();
}

/// Of those sides that have a sample in every pixel.
void measureErrors(const CompareInput& input, CompareResult& result) {
    const FilmImage &a = *input.a->film, &b = *input.b->film;
    if (input.reference == CompareReference::kept) {
        if (!input.kept || input.kept->pixels.size() != a.mean.pixels.size() || input.kept->width != a.mean.width)
            return;
        if (input.a->samples > 0) result.errorA = std::sqrt(compareImages(a.picture(), *input.kept).relMse);
        if (input.b->samples > 0) result.errorB = std::sqrt(compareImages(b.picture(), *input.kept).relMse);
        return;
    }
    if (input.a->samples < 2 || input.b->samples < 2) return;  // noise is not known yet
    if (!a.denoised.pixels.empty() || !b.denoised.pixels.empty()) return;  // nor ever, but against a picture that is kept
    const double noiseA = relativeNoise(a), noiseB = relativeNoise(b);
    const bool aIsBetter = noiseA <= noiseB;
    // Both have the same random numbers, so that what they differ by may be less than the other's noise.
    const auto against = [](const FilmImage& image, const FilmImage& better, double noise) {
        return std::max(std::sqrt(compareImages(image.picture(), better.picture()).relMse), noise);
    };
    result.errorA = aIsBetter ? noiseA : against(a, b, noiseA);
    result.errorB = aIsBetter ? against(b, a, noiseB) : noiseB;
}

}  // namespace

std::span<const CompareModeInfo> compareModes() { return kModes; }

const CompareModeInfo& infoOf(CompareMode mode) { return kModes[static_cast<size_t>(mode)]; }

CompareMode findCompareMode(std::string_view name) {
    std::string known;
    for (const CompareModeInfo& info : kModes) {
        if (info.name == name) return info.mode;
        known += (known.empty() ? "" : ", ") + std::string(info.name);
    }
    throw Error("there is no comparison '" + std::string(name) + "'; use one of " + known);
}

bool isDifference(CompareMode mode) { return mode >= CompareMode::absolute; }

HeatScale heatScaleOf(CompareMode mode) {
    switch (mode) {
        case CompareMode::absolute:
            return {1e-3, 10.0, true};
        case CompareMode::relative:
            return {1e-2, 10.0, true};
        case CompareMode::zScore:
            return {0.0, 5.0, false};
        default:
            return {0.0, 1.0, false};
    }
}

CompareResult comparePictures(const CompareInput& input) {
    CompareResult result;
    result.mode = input.mode;
    result.numberA = input.a->number;
    result.numberB = input.b->number;
    result.secondsA = input.a->seconds;
    result.secondsB = input.b->seconds;
    result.isDenoisedA = !input.a->film->denoised.pixels.empty();
    result.isDenoisedB = !input.b->film->denoised.pixels.empty();
    result.width = input.a->width;
    result.height = input.a->height;
    if (input.a->width != input.b->width || input.a->height != input.b->height ||
        !(input.a->camera == input.b->camera)) {
        result.mismatch = "waiting for pictures of the same view";
        return result;
    }
    if (isDifference(input.mode) && input.mode != CompareMode::firstHit &&
        (input.a->samples == 0 || input.b->samples == 0)) {
        result.mismatch = "waiting for a sample in every pixel";
        return result;
    }
    if (isDifference(input.mode)) showDifference(input, result);
    measureErrors(input, result);
    return result;
}

}  // namespace raylab
