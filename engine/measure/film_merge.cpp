#include "engine/measure/film_merge.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <sstream>

#include "engine/core/error.h"
#include "engine/measure/image_pair.h"
#include "engine/measure/setting_effects.h"
#include "engine/render/render_settings.h"

namespace raylab {
namespace {

/// What a file says of itself besides its settings and its scene.
constexpr std::array<std::string_view, 5> kOwnFigures = {"samples", "device-name", "merged-parts", "clamped-energy",
                                                         "version"};

/// Parts of one picture may differ in how they were made, but not in what they estimate, nor by which estimator.
bool mayDiffer(std::string_view key) {
    return key == "seed" || key == "spp" || isSpeedSetting(key) ||
           std::ranges::find(kOwnFigures, key) != kOwnFigures.end();
}

std::string valueOf(const Metadata& metadata, std::string_view key) {
    const auto found =
        std::ranges::find(metadata, key, [](const auto& entry) { return std::string_view(entry.first); });
    return found != metadata.end() ? found->second : std::string();
}

void setValue(Metadata& metadata, const std::string& key, const std::string& value) {
    const auto found = std::ranges::find(metadata, key, [](const auto& entry) { return entry.first; });
    if (found != metadata.end())
        found->second = value;
    else
        metadata.emplace_back(key, value);
}

std::vector<std::string> seedsOf(const FilmPart& part) {
    std::vector<std::string> seeds;
    std::istringstream stream(valueOf(part.metadata, "seed"));
    for (std::string seed; stream >> seed;) seeds.push_back(seed);
    if (seeds.empty()) throw Error(part.name + ": does not say its seed; only what raylab render writes can be merged");
    return seeds;
}

void requireSameSettings(const FilmPart& first, const FilmPart& part) {
    if (part.mean.width != first.mean.width || part.mean.height != first.mean.height)
        throw Error(part.name + ": is " + std::to_string(part.mean.width) + " x " + std::to_string(part.mean.height) +
                    " pixels, " + first.name + " is " + std::to_string(first.mean.width) + " x " +
                    std::to_string(first.mean.height) + "; only parts of one picture can be merged");
    std::set<std::string> keys;
    for (const Metadata* metadata : {&first.metadata, &part.metadata})
        for (const auto& [key, value] : *metadata) keys.insert(key);
    std::string differences;
    for (const std::string& key : keys) {
        if (mayDiffer(key)) continue;
        const std::string a = valueOf(first.metadata, key), b = valueOf(part.metadata, key);
        if (a != b) differences += (differences.empty() ? "" : ", ") + key + " '" + b + "' instead of '" + a + "'";
    }
    if (!differences.empty())
        throw Error(part.name + ": has " + differences + " of " + first.name +
                    "; render the parts with the same settings");
}

void requireNewSeeds(const std::vector<std::string>& known, const FilmPart& part) {
    for (const std::string& seed : seedsOf(part))
        if (std::ranges::find(known, seed) != known.end())
            throw Error(part.name + ": seed " + seed +
                        " is in another part, whose samples are the same; render it with another --seed");
}

/// Sums of one pixel and channel.
struct Moments {
    double count = 0.0;
    double mean = 0.0;
    double squares = 0.0;  ///< of deviations from the mean

    void add(const Moments& other) {
        if (other.count == 0.0) return;
        const double total = count + other.count;
        const double difference = other.mean - mean;
        squares += other.squares + difference * difference * count * other.count / total;
        mean += difference * other.count / total;
        count = total;
    }
};

Moments momentsOf(const FilmPart& part, size_t pixel, size_t value) {
    const double count = double{part.samples.pixels[pixel]};
    return {count, double{part.mean.pixels[value]}, double{part.variance.pixels[value]} * std::max(0.0, count - 1.0)};
}

uint64_t sumOf(std::span<const FilmPart> parts, std::string_view key) {
    uint64_t sum = 0;
    for (const FilmPart& part : parts) {
        const std::string text = valueOf(part.metadata, key);
        uint64_t value = 0;
        std::from_chars(text.data(), text.data() + text.size(), value);
        sum += value;
    }
    return sum;
}

void poolPixels(std::span<const FilmPart> parts, FilmPart& result) {
    const auto channels = static_cast<size_t>(result.mean.channels);
    for (size_t pixel = 0; pixel < result.mean.pixelCount(); ++pixel) {
        for (size_t c = 0; c < channels; ++c) {
            const size_t value = pixel * channels + c;
            Moments moments;
            for (const FilmPart& part : parts) moments.add(momentsOf(part, pixel, value));
            result.mean.pixels[value] = static_cast<float>(moments.mean);
            result.variance.pixels[value] =
                static_cast<float>(moments.count > 1.0 ? moments.squares / (moments.count - 1.0) : 0.0);
            result.samples.pixels[pixel] = static_cast<float>(moments.count);
        }
    }
}

}  // namespace

FilmPart readFilmPart(const std::string& path) {
    FilmPart part;
    part.name = path;
    const std::vector<Layer> layers = readExrLayers(path, &part.metadata);
    const auto layer = [&](std::string_view name, int channels) {
        const auto found = std::ranges::find(layers, name, &Layer::name);
        if (found == layers.end() || found->bitmap.channels != channels)
            throw Error(path + ": has no layer '" + std::string(name.empty() ? "RGB" : name) + "' of " +
                        std::to_string(channels) + " channels; only EXR files that raylab render writes can be merged");
        return found->bitmap;
    };
    const bool isDenoised = std::ranges::count(layers, "raw", &Layer::name) > 0;
    part.mean = layer(isDenoised ? "raw" : "", 3);
    part.variance = layer(isDenoised ? "raw-variance" : "variance", 3);
    setValue(part.metadata, "denoise", kNoDenoiser);
    part.samples = layer("samples", 1);
    return part;
}

FilmPart mergeFilms(std::span<const FilmPart> parts) {
    if (parts.empty()) throw Error("there is nothing to merge; name the parts");
    std::vector<std::string> seeds;
    for (const FilmPart& part : parts) {
        requireSameSettings(parts.front(), part);
        requireNewSeeds(seeds, part);
        for (const std::string& seed : seedsOf(part)) seeds.push_back(seed);
    }
    FilmPart result = parts.front();
    poolPixels(parts, result);
    std::string seedText;
    for (const std::string& seed : seeds) seedText += (seedText.empty() ? "" : " ") + seed;
    setValue(result.metadata, "seed", seedText);
    setValue(result.metadata, "spp", std::to_string(sumOf(parts, "spp")));
    setValue(result.metadata, "samples", std::to_string(sumOf(parts, "samples")));
    setValue(result.metadata, "merged-parts", std::to_string(parts.size()));
    return result;
}

}  // namespace raylab
