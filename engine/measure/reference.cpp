#include "engine/measure/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "engine/accel/bvh_cache.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/image/image_io.h"
#include "engine/measure/image_pair.h"
#include "engine/measure/scene_hash.h"
#include "engine/measure/setting_effects.h"
#include "engine/render/lighting.h"
#include "engine/render/renderer.h"

namespace raylab {
namespace fs = std::filesystem;
namespace {

/// Longer paths carry less than a millionth of the light of anything but near-perfect mirrors face to face.
constexpr int64_t kReferenceDepth = 256;
constexpr int kParts = 4;
constexpr uint32_t kPilotSamples = 16;
/// Aims beyond what is asked for: the estimate of what it takes is itself noisy.
constexpr double kMargin = 1.2;
constexpr int kMostRounds = 6;
/// Of the files: a change of what kernels compute, or of the format, takes a new one.
constexpr int kVersion = 1;

/// Shortcuts, and what only other methods know: path tracing without shortcuts has them at their defaults.
constexpr std::array<std::string_view, 20> kShortcuts = {
    "depth",       "integrator", "fresnel",          "geometry",  "alpha-mapping",  "shadows",   "ambient",
    "attenuation", "highlight",  "reflection",       "threshold", "beyond",         "antialias", "ao-rays",
    "ao-distance", "clamp",      "mirror-roughness", "offset",    "offset-epsilon", "slab"};

bool isShortcut(std::string_view name) { return std::ranges::find(kShortcuts, name) != kShortcuts.end(); }

/// Of the mean of the parts, from how the parts differ.
Bitmap varianceOfMean(const SeedImages& parts) {
    Bitmap variance = parts.variance();
    for (float& value : variance.pixels) value /= static_cast<float>(parts.count());
    return variance;
}

double relativeErrorOf(const ReferenceImage& image) {
    return std::sqrt(referenceNoise(image, errorWeights(image.mean, true)));
}

/// Renders the parts with `samples` each; nothing where it is stopped.
std::optional<ReferenceImage> renderParts(Renderer& renderer, uint32_t samples, uint32_t firstSeed,
                                          const std::function<bool()>& stop,
                                          const std::function<void(double)>& progress) {
    std::optional<SeedImages> parts;
    for (int part = 0; part < kParts; ++part) {
        renderer.restart(firstSeed + static_cast<uint32_t>(part), samples);
        while (renderer.step()) {
            if (stop()) return std::nullopt;
            progress((part + renderer.fractionDone()) / kParts);
        }
        const Bitmap mean = renderer.snapshot().mean;
        if (!parts) parts.emplace(mean.width, mean.height, mean.channels);
        parts->add(mean);
    }
    return ReferenceImage{parts->mean(), varianceOfMean(*parts), kParts};
}

std::optional<Reference> renderReference(Device& device, Scene scene, const RenderSettings& settings,
                                         double relativeError, const std::function<bool()>& stop,
                                         const std::function<void(double)>& progress) {
    const std::function<void(double)> unseen = [](double) {};
    settleEnvironment(scene, settings);
    Renderer renderer(device, scene, settings);
    uint32_t samples = kPilotSamples;
    uint32_t seed = kFirstReferenceSeed;
    for (int round = 0; round < kMostRounds; ++round) {
        const auto image = renderParts(renderer, samples, seed, stop, round == 0 ? unseen : progress);
        if (!image) return std::nullopt;
        const double error = relativeErrorOf(*image);
        if (error <= relativeError) return Reference{*image, error, samples * kParts, "rendered"};
        const double wanted = samples * std::pow(error / relativeError, 2.0) * kMargin;
        samples = static_cast<uint32_t>(std::clamp(std::ceil(wanted), samples + 1.0, 4e9));
        seed += kParts;
    }
    throw Error("the reference does not reach a relative error of " + std::to_string(relativeError) +
                "; give a larger --reference-error, or a file by --reference");
}

/// The layers that raylab render writes, with a variance of one sample that makes the variance of the mean come out.
void store(const fs::path& file, const Reference& reference, const RenderSettings& settings) {
    Bitmap variance = reference.image.varianceOfMean;
    Bitmap samples(variance.width, variance.height, 1);
    const auto count = static_cast<float>(reference.samples);
    for (float& value : variance.pixels) value *= count;
    std::ranges::fill(samples.pixels, count);
    Metadata metadata{{"relative-error", settingText(reference.relativeError)},
                      {"parts", std::to_string(reference.image.parts)}};
    for (const Setting<RenderSettings>& setting : renderSettingsTable())
        metadata.emplace_back(setting.name, settingText(getSetting(setting, settings)));
    writeExr(file, std::array{Layer{"", reference.image.mean}, Layer{"variance", variance}, Layer{"samples", samples}},
             metadata);
}

std::string metadataValue(const Metadata& metadata, std::string_view key) {
    const auto found =
        std::ranges::find(metadata, key, [](const auto& entry) { return std::string_view(entry.first); });
    return found != metadata.end() ? found->second : std::string();
}

const Bitmap* findLayer(const std::vector<Layer>& layers, std::string_view name) {
    const auto found = std::ranges::find(layers, name, &Layer::name);
    return found != layers.end() ? &found->bitmap : nullptr;
}

/// By the layers of raylab render: the variance of the mean, 0 everywhere without them; and of a denoised picture the
/// one before, which has no bias.
void readLayers(const fs::path& path, Reference& reference) {
    ReferenceImage& image = reference.image;
    image.varianceOfMean = Bitmap(image.mean.width, image.mean.height, image.mean.channels);
    if (path.extension() != ".exr") return;
    Metadata metadata;
    const std::vector<Layer> layers = readExrLayers(path, &metadata);
    const Bitmap* raw = findLayer(layers, "raw");
    if (raw != nullptr) {
        requireSameShape(*raw, image.mean);
        image.mean = *raw;
    }
    const Bitmap* variance = findLayer(layers, raw != nullptr ? "raw-variance" : "variance");
    const Bitmap* samples = findLayer(layers, "samples");
    if (variance == nullptr || samples == nullptr) return;
    requireSameShape(*variance, image.mean);
    for (size_t i = 0; i < variance->pixels.size(); ++i)
        image.varianceOfMean.pixels[i] =
            variance->pixels[i] / std::max(1.0f, samples->pixels[i / static_cast<size_t>(variance->channels)]);
    reference.samples = static_cast<uint32_t>(samples->pixels.front());
    // Our own references have few parts; a rendering has as many as samples.
    image.parts = metadataValue(metadata, "parts").empty() ? std::max(2, static_cast<int>(reference.samples)) : kParts;
}

/// A damaged file is as good as none.
std::optional<Reference> loadStored(const fs::path& file, const RenderSettings& settings, double relativeError) {
    std::error_code code;
    if (!fs::is_regular_file(file, code)) return std::nullopt;
    try {
        Reference reference = readReference(file, static_cast<int>(settings.width), static_cast<int>(settings.height));
        if (reference.relativeError > relativeError) return std::nullopt;
        return reference;
    } catch (const Error& error) {
        logWarning(std::string(error.what()) + "; it is rendered anew");
        return std::nullopt;
    }
}

}  // namespace

RenderSettings referenceSettings(RenderSettings settings, ReferenceKind kind) {
    const bool isPath = kind == ReferenceKind::path;
    for (const Setting<RenderSettings>& setting : renderSettingsTable())
        if (isSpeedSetting(setting.name) || isNoiseSetting(setting.name) || (isPath && isShortcut(setting.name)))
            setSetting(setting, settings, settingText(getSetting(setting, RenderSettings{})));
    if (isPath) settings.depth = kReferenceDepth;
    return settings;
}

Reference readReference(const fs::path& path, int width, int height) {
    Reference reference;
    reference.image.mean = readImage(path);
    const Bitmap& mean = reference.image.mean;
    if (mean.width != width || mean.height != height)
        throw Error(path.string() + ": has " + std::to_string(mean.width) + " x " + std::to_string(mean.height) +
                    " pixels, the chart's images have " + std::to_string(width) + " x " + std::to_string(height) +
                    "; give --width and --height of the reference");
    readLayers(path, reference);
    reference.relativeError = relativeErrorOf(reference.image);
    reference.origin = path.string();
    return reference;
}

fs::path referenceFolder() {
    const fs::path trees = bvhCacheFolder();
    return trees.empty() ? trees : trees.parent_path() / "references";
}

fs::path referenceFile(const fs::path& folder, const Scene& scene, const RenderSettings& settings) {
    std::string text = std::to_string(kVersion) + " " + sceneHash(scene);
    for (const Setting<RenderSettings>& setting : renderSettingsTable())
        text += " " + std::string(setting.name) + "=" + settingText(getSetting(setting, settings));
    Hash128 hash = hashBytes(std::as_bytes(std::span(text)));
    std::error_code code;
    if (fs::is_regular_file(settings.environment, code)) hash = hashBytes(readFile(settings.environment), hash);
    std::array<char, 33> name{};
    std::snprintf(name.data(), name.size(), "%016llx%016llx", static_cast<unsigned long long>(hash.high),
                  static_cast<unsigned long long>(hash.low));
    return folder / (std::string(name.data()) + ".exr");
}

std::optional<Reference> obtainReference(Device& device, const Scene& scene, const RenderSettings& settings,
                                         double relativeError, const fs::path& folder,
                                         const std::function<bool()>& stop,
                                         const std::function<void(double)>& progress) {
    const fs::path file = folder.empty() ? fs::path() : referenceFile(folder, scene, settings);
    if (!file.empty())
        if (std::optional<Reference> stored = loadStored(file, settings, relativeError)) return stored;
    std::optional<Reference> reference = renderReference(device, scene, settings, relativeError, stop, progress);
    if (!reference || file.empty()) return reference;
    store(file, *reference, settings);
    reference->origin = file.string();
    return reference;
}

}  // namespace raylab
