#include "ui/report/chart_files.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/image_io.h"
#include "engine/measure/image_error.h"
#include "engine/render/tonemap.h"
#include "ui/report/settings_file.h"

namespace raylab {
namespace fs = std::filesystem;
namespace {

constexpr int kPictureWidth = 320;

std::string padded(size_t config) { return (config < 10 ? "0" : "") + std::to_string(config); }

/// Pixels of a picture that is at most so wide, each the mean of a block.
Bitmap shrunk(const Bitmap& bitmap) {
    const int block = (bitmap.width + kPictureWidth - 1) / kPictureWidth;
    Bitmap small(std::max(1, bitmap.width / block), std::max(1, bitmap.height / block), bitmap.channels);
    const int blockHeight = std::min(block, bitmap.height);
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x)
            for (int c = 0; c < bitmap.channels; ++c) {
                float sum = 0.0f;
                for (int dy = 0; dy < blockHeight; ++dy)
                    for (int dx = 0; dx < block; ++dx) sum += bitmap.at(x * block + dx, y * blockHeight + dy)[c];
                small.at(x, y)[c] = sum / static_cast<float>(block * blockHeight);
            }
    return small;
}

/// Without what the chart itself chooses.
nlohmann::ordered_json comparableSettings(const RenderSettings& settings) {
    nlohmann::ordered_json json = settingsJson(settings);
    for (const char* name : {"spp", "seed", "time-limit", "target-error", "slice-ms", "device", "validation"})
        json.erase(name);
    return json;
}

[[noreturn]] void refuse(const Chart& chart, const std::string& what) {
    throw Error(chart.folder.string() + ": has a chart of " + what +
                "; give the arguments it was made with, another folder by -o, or delete it");
}

/// The first name of an object whose values differ; empty where none does.
std::string firstDifference(const nlohmann::json& a, const nlohmann::json& b) {
    for (const auto& [name, value] : a.items())
        if (!b.contains(name) || b[name] != value) return name;
    return {};
}

void requireSameIdentity(const Chart& chart, const nlohmann::json& old) {
    const nlohmann::json now = chartIdentity(chart);
    for (const char* name : {"scene", "device", "error", "seeds", "firstSeed", "reference", "referenceError"})
        if (!old.contains(name) || old[name] != now[name]) {
            const std::string before = old.contains(name) ? old[name].dump() : "nothing";
            refuse(chart, std::string(name) + " " + before + " instead of " + now[name].dump());
        }
    for (const auto& [config, settings] : old["configs"].items()) {
        if (!now["configs"].contains(config)) refuse(chart, "a configuration '" + config + "', which is not asked for");
        const std::string differs = firstDifference(now["configs"][config], settings);
        if (!differs.empty())
            refuse(chart, "'" + config + "' with " + differs + " " + settings.value(differs, nlohmann::json()).dump() +
                              " instead of " + now["configs"][config][differs].dump());
    }
}

fs::path partialFolder(const Chart& chart) { return chart.folder / "partial"; }

std::string metadataOf(const Metadata& metadata, const std::string& key) {
    const auto found = std::ranges::find(metadata, key, [](const auto& entry) { return entry.first; });
    return found != metadata.end() ? found->second : std::string();
}

uint32_t wholeNumber(const std::string& text, const fs::path& path) {
    uint32_t value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || text.empty())
        throw Error(path.string() + ": was not written by raylab chart; delete it");
    return value;
}

std::vector<PartialSeeds> readPartials(const Chart& chart) {
    std::vector<PartialSeeds> partials;
    std::error_code code;
    for (const fs::directory_entry& entry : fs::directory_iterator(partialFolder(chart), code)) {
        if (entry.path().extension() != ".exr") continue;
        Metadata metadata;
        const std::vector<Layer> layers = readExrLayers(entry.path(), &metadata);
        const auto variance = std::ranges::find(layers, "variance", &Layer::name);
        if (variance == layers.end())
            throw Error(entry.path().string() + ": was not written by raylab chart; delete it");
        partials.push_back({metadataOf(metadata, "config"), wholeNumber(metadataOf(metadata, "samples"), entry.path()),
                            SeedImages(layers.front().bitmap, variance->bitmap,
                                       wholeNumber(metadataOf(metadata, "seeds"), entry.path()))});
    }
    return partials;
}

}  // namespace

fs::path Chart::pictureFile(size_t config, uint32_t samples) const {
    return folder / "pictures" / (padded(config) + "-" + std::to_string(samples) + ".png");
}

fs::path Chart::heatFile(size_t config, uint32_t samples) const {
    return folder / "pictures" / (padded(config) + "-" + std::to_string(samples) + "-error.png");
}

std::string Chart::renderCommand(size_t config) const {
    RenderSettings settings = plan.configs[config].settings;
    settings.timeLimit = settings.targetError = 0.0;
    return "raylab render " + shellQuoted(scene) + settingsAsOptions(settings);
}

void analyse(Chart& chart) {
    std::vector<std::string> names;
    std::vector<double> noise;
    for (size_t i = 0; i < chart.plan.configs.size(); ++i) {
        names.push_back(chart.plan.configs[i].name);
        const ReferenceImage& reference = chart.references[i]->image;
        const bool relative = chart.plan.measure == ErrorMeasure::relative;
        noise.push_back(chart.plan.measure == ErrorMeasure::flip
                            ? 0.0
                            : referenceNoise(reference, errorWeights(reference.mean, relative)));
    }
    chart.curves = analyseChart(chart.table, names, chart.plan.measure, noise);
}

void writeChartCsv(const Chart& chart) {
    const std::string text = chartCsv(chart.table, marksOf(chart.table, chart.curves), chart.plan.measure);
    writeFileAtomically(chart.csvFile(), std::as_bytes(std::span(text)));
}

nlohmann::ordered_json chartIdentity(const Chart& chart) {
    nlohmann::ordered_json configs = nlohmann::ordered_json::object();
    for (const ChartConfig& config : chart.plan.configs) configs[config.name] = comparableSettings(config.settings);
    return {{"scene", chart.sceneHash},
            {"device", chart.device},
            {"error", nameOf(chart.plan.measure)},
            {"seeds", chart.plan.seeds},
            {"firstSeed", chart.plan.firstSeed},
            {"reference", chart.referenceChoice},
            {"referenceError", chart.referenceError},
            {"configs", configs}};
}

std::optional<EarlierChart> loadEarlier(const Chart& chart) {
    if (!fs::exists(chart.csvFile())) return std::nullopt;
    if (!fs::exists(chart.jsonFile())) refuse(chart, "unknown origin (there is no chart.json)");
    const nlohmann::json json = readJsonFile(chart.jsonFile().string());
    if (!json.is_object() || !json.contains("identity") || !json["identity"].contains("configs"))
        refuse(chart, "unknown origin (chart.json says nothing of it)");
    requireSameIdentity(chart, json["identity"]);
    return EarlierChart{readChartCsv(chart.csvFile()), readPartials(chart)};
}

void writePartials(const Chart& chart) {
    std::error_code code;
    fs::remove_all(partialFolder(chart), code);
    for (size_t i = 0; i < chart.partials.size(); ++i) {
        const PartialSeeds& partial = chart.partials[i];
        writeExr(partialFolder(chart) / (std::to_string(i) + ".exr"),
                 std::array{Layer{"", partial.images.mean()}, Layer{"variance", partial.images.variance()}},
                 {{"config", partial.config},
                  {"samples", std::to_string(partial.samples)},
                  {"seeds", std::to_string(partial.images.count())}});
    }
}

ChartPictures makePictures(const Chart& chart, const ChartShot& shot) {
    const RenderSettings& settings = chart.plan.configs[shot.config].settings;
    return {encodeSrgb8(shrunk(tonemapImage(shot.image, settings.exposure, settings.tonemap))),
            encodeSrgb8(shrunk(errorHeatMap(shot.image, chart.references[shot.config]->image.mean)))};
}

void writePictures(const Chart& chart, size_t config, uint32_t samples, const ChartPictures& pictures) {
    const auto write = [](const fs::path& file, const Image8& image) {
        writeFileAtomically(file, encodePng8(image.texels, image.width, image.height));
    };
    write(chart.pictureFile(config, samples), pictures.image);
    write(chart.heatFile(config, samples), pictures.heat);
}

}  // namespace raylab
