#include <algorithm>
#include <cstdio>
#include <iostream>
#include <numeric>

#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/render/device_defaults.h"
#include "engine/render/lighting.h"
#include "engine/scene/import.h"
#include "ui/cli/commands.h"
#include "ui/cli/options.h"
#include "ui/cli/render_job.h"

namespace raylab {
namespace {

constexpr const char* kDefaultScene = "courtyard";

struct RenderOptions {
    std::string scene = kDefaultScene;
    std::string output;
    std::string json;
    bool quiet = false;
    std::unique_ptr<SettingOptions> settings;
};

double raysPerSecond(const RenderResult& result) {
    return result.times.render > 0.0 ? static_cast<double>(result.image.rays) / result.times.render : 0.0;
}

/// Under --adaptive pixels differ.
nlohmann::ordered_json samplesJson(const Bitmap& samples) {
    const auto [least, most] = std::ranges::minmax(samples.pixels);
    const double sum = std::accumulate(samples.pixels.begin(), samples.pixels.end(), 0.0);
    return {{"least", least}, {"mean", sum / static_cast<double>(samples.pixels.size())}, {"most", most}};
}

nlohmann::ordered_json resultJson(const RenderOptions& options, const RenderSettings& settings,
                                  ReplaceableDevice& device, const RenderResult& r) {
    nlohmann::ordered_json seconds{{"import", r.importSeconds},    {"build", r.times.build},   {"upload", r.times.upload},
                                   {"compile", r.times.compile},   {"render", r.times.render}, {"denoise", r.times.denoise}, {"total", r.totalSeconds},
                                   {"device", r.times.device},     {"longestDispatch", r.times.longestDispatch}};
    return {{"schema", "raylab.render/1"},
            {"version", RAYLAB_VERSION},
            {"scene", options.scene},
            {"settings", settingsJson(settings)},
            {"device", device.get().description().name},
            {"seconds", seconds},
            {"samples", r.samples},
            {"samplesPerPixel", samplesJson(r.image.samples)},
            {"rays", r.image.rays},
            {"raysPerSecond", raysPerSecond(r)},
            {"samplesPerSecond", r.times.render > 0.0 ? static_cast<double>(r.pixelSamples) / r.times.render : 0.0},
            {"estimatedRelativeError", r.image.estimatedRelativeError},
            {"nonFinitePixels", r.image.nonFinitePixels},
            {"clampedEnergy", r.image.clampedEnergy},
            {"memoryBytes", {{"scene", r.sceneBytes}, {"traversal", r.traceBytes}, {"film", r.filmBytes}, {"queues", r.queueBytes}}},
            {"stoppedBy", r.stoppedBy},
            {"deviceLosses", r.deviceLosses},
            {"validationMessages", device.validationMessageCount()},
            {"output", options.output}};
}

Metadata resultMetadata(const RenderOptions& options, const RenderSettings& settings, const Device& device, const RenderResult& r) {
    Metadata metadata = settingsMetadata(settings);
    metadata.emplace_back("scene", options.scene);
    metadata.emplace_back("version", RAYLAB_VERSION);
    metadata.emplace_back("device-name", device.description().name);
    metadata.emplace_back("samples", std::to_string(r.samples));
    if (settings.clamp > 0.0) metadata.emplace_back("clamped-energy", std::to_string(r.image.clampedEnergy));
    return metadata;
}

std::string summary(const RenderOptions& options, const RenderSettings& settings, const RenderResult& r) {
    char text[256];
    std::snprintf(text, sizeof(text),
                  "%s  %u samples  %.2f s in all (import %.2f, build %.2f, upload %.2f, compile %.2f, render %.2f)  %.2f Mrays/s",
                  options.output.c_str(), r.samples, r.totalSeconds, r.importSeconds, r.times.build, r.times.upload,
                  r.times.compile, r.times.render, raysPerSecond(r) * 1e-6);
    std::string line = text;
    const bool isDenoised = !r.image.denoised.pixels.empty();
    if (isDenoised) {
        std::snprintf(text, sizeof(text), "  denoised in %.2f s", r.times.denoise);
        line += text;
    }
    if (r.samples >= 2) {
        std::snprintf(text, sizeof(text), isDenoised ? ", noise before %.2f%%" : "  noise %.2f%%",
                      100.0 * r.image.estimatedRelativeError);
        line += text;
    }
    if (settings.clamp > 0.0) {
        std::snprintf(text, sizeof(text), "\nclamping at %g took %.3g%% of the light", settings.clamp,
                      100.0 * r.image.clampedEnergy);
        line += text;
    }
    return line;
}

ExitCode render(RenderOptions options) {
    const Stopwatch total;
    setQuiet(options.quiet);
    RenderSettings settings = options.settings->resolve();
    const std::filesystem::path path = scenePath(options.scene);
    if (options.output.empty()) options.output = (std::filesystem::path("out") / path.stem()).string() + ".png";
    requireImageExtension(options.output);
    requireReadableFile(path);
    requireWritable(options.output);

    ReplaceableDevice device({settings.device, settings.validation});
    Stopwatch watch;
    Scene scene = importScene(path);
    const double importSeconds = watch.restart();
    settleEnvironment(scene, settings);
    settings = resolveForDevice(settings, device.get().description(), scene);
    for (const std::string& warning : scene.warnings) logWarning(warning);
    RenderResult result = renderDespiteLosses(device, scene, settings, options.quiet);
    result.importSeconds = importSeconds;
    if (result.image.denoised.pixels.empty()) settings.denoise = kNoDenoiser;  // of a view, or one that was stopped
    writeRender(options.output, result, settings, resultMetadata(options, settings, device.get(), result));
    result.totalSeconds = total.seconds();
    if (!options.json.empty()) writeJson(options.json, resultJson(options, settings, device, result));
    if (options.json != "-") std::cout << summary(options, settings, result) << "\n";
    if (result.image.nonFinitePixels > 0)
        logWarning(std::to_string(result.image.nonFinitePixels) + " pixels had samples that are not finite; these are left out");
    if (result.stoppedBy == kStoppedByLoss) return ExitCode::noDevice;
    return device.validationMessageCount() > 0 ? ExitCode::checkFailed : ExitCode::done;
}

}  // namespace

void addRenderCommand(CLI::App& app, Command& chosen) {
    CLI::App* command = app.add_subcommand("render", "render a scene to an image");
    const auto options = std::make_shared<RenderOptions>();
    command->add_option("scene", options->scene, "glTF, GLB, OBJ, PLY or STL; or the name of a scene of raylab's own")->capture_default_str();
    command->add_option("-o,--output", options->output, "image to write: .png, .exr or .hdr [out/NAME.png]")->type_name("FILE");
    command->add_option("--json", options->json, "write settings, times and results to a file, or - for standard output")->type_name("FILE");
    command->add_flag("--quiet", options->quiet, "no progress; warnings only");
    options->settings = std::make_unique<SettingOptions>(*command);
    command->callback([&chosen, options] { chosen = [options] { return render(std::move(*options)); }; });
}

}  // namespace raylab
