#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/measure/embree_caster.h"
#include "engine/render/camera.h"
#include "engine/render/device_defaults.h"
#include "engine/render/lighting.h"
#include "engine/scene/import.h"
#include "ui/cli/commands.h"
#include "ui/cli/compare_tracers_output.h"
#include "ui/cli/render_job.h"

namespace raylab {
namespace {

/// Small enough for a first look on a CPU.
constexpr std::array<std::pair<const char*, int64_t>, 3> kSmallDefaults = {
    {{"width", 512}, {"height", 288}, {"spp", 4}}};
/// Of the pixels, so many must pass the Z-test: what Mitsuba's own tests ask for.
constexpr double kPassFraction = 0.9975;
constexpr double kProgressInterval = 5.0;  ///< seconds
constexpr std::array kSteps = {"hits", "images", "time"};

/// Settings that decide how rays are traced: those of the default are the default software configuration.
constexpr std::array kTracingSettings = {"tracer",         "builder",     "layout",         "triangle",
                                         "leaf-size",      "bins",        "traversal-cost", "intersection-cost",
                                         "spatial-budget", "reinsertion", "trees",          "flatten-limit",
                                         "needs",          "slab"};
/// Settings of what is looked at, which cannot differ.
constexpr std::array kCommonSettings = {"width",         "height",     "camera",      "device",
                                        "validation",    "time-limit", "environment", "environment-scale",
                                        "sun-elevation", "sun-azimuth"};

struct CompareTracersOptions {
    explicit CompareTracersOptions(CLI::App& command_) : command(command_), settings(command_) {}

    CLI::App& command;
    SettingOptions settings;
    std::string scene;
    std::vector<std::string> a{"software"};
    std::vector<std::string> b;
    std::vector<std::string> only{kSteps.begin(), kSteps.end()};
    std::string output;
    std::string heat;
    std::string json;
    uint64_t rays = 1'000'000;
    size_t offenders = 16;
    int repeats = 5;
    bool quiet = false;

    bool wants(const char* step) const { return std::ranges::count(only, step) > 0; }
    bool isGiven(const std::string& name) const {
        const auto sets = command.get_option("--set")->results();
        return command.count("--" + name) > 0 ||
               std::ranges::any_of(sets, [&](const std::string& set) { return set.starts_with(name + "="); });
    }
};

/// When the steps have to end: each gets an equal share of the time that is left.
class TimeBudget {
public:
    TimeBudget(double limitSeconds, size_t steps) : limit_(limitSeconds), stepsLeft_(steps) {}

    /// Seconds for the next step; 0: no limit.
    double beginStep() {
        share_ = limit_ > 0.0 ? std::max(limit_ - watch_.seconds(), 0.01) / static_cast<double>(stepsLeft_) : 0.0;
        end_ = watch_.seconds() + share_;
        --stepsLeft_;
        return share_;
    }
    bool isOver() const { return share_ > 0.0 && watch_.seconds() >= end_; }

private:
    Stopwatch watch_;
    double limit_;
    size_t stepsLeft_;
    double share_ = 0.0;
    double end_ = 0.0;
};

RenderSettings commonSettings(const CompareTracersOptions& options) {
    RenderSettings settings = options.settings.resolve();
    for (const auto& [name, value] : kSmallDefaults)
        if (!options.isGiven(name))
            setSetting(findSetting(renderSettingsTable(), name), settings, std::to_string(value));
    return settings;
}

/// Sides that are none of raylab's tracers: they answer for rays, and render nothing.
constexpr std::array kPeers = {"embree", "embree-robust"};

/// The peer that the first of the parts names; empty where it names none.
std::string peerOf(const char* flag, const std::vector<std::string>& parts) {
    const bool isPeer = std::ranges::count(kPeers, parts.front()) > 0;
    if (isPeer && parts.size() > 1) throw Error(std::string(flag) + ": " + parts.front() + " takes no settings");
    return isPeer ? parts.front() : "";
}

/// `parts`: NAME or SETTING=VALUE; a peer leaves the settings as they are.
RenderSettings sideSettings(const RenderSettings& common, const char* flag, const std::vector<std::string>& parts) {
    RenderSettings settings = common;
    if (!peerOf(flag, parts).empty()) return settings;
    bool named = false;
    for (const std::string& part : parts) {
        const size_t equals = part.find('=');
        const std::string name = equals == std::string::npos ? "tracer" : part.substr(0, equals);
        if (equals == std::string::npos && std::exchange(named, true))
            throw Error(std::string(flag) + " names two tracers; '" + part + "' should be SETTING=VALUE");
        if (std::ranges::count(kCommonSettings, name) > 0)
            throw Error(std::string(flag) + ": " + name + " is the same for both sides; give --" + name);
        setSetting(findSetting(renderSettingsTable(), name), settings,
                   equals == std::string::npos ? part : part.substr(equals + 1));
    }
    return settings;
}

bool tracesByDefault(const RenderSettings& settings, const DeviceDescription& device, const Scene& scene) {
    const RenderSettings standard = resolveForDevice({}, device, scene);
    return std::ranges::all_of(kTracingSettings, [&](const char* name) {
        const Setting<RenderSettings>& setting = findSetting(renderSettingsTable(), name);
        return getSetting(setting, settings) == getSetting(setting, standard);
    });
}

CompareSide makeSide(const char* flag, const RenderSettings& settings, const std::vector<std::string>& parts,
                     const DeviceDescription& device, const Scene& scene) {
    CompareSide side;
    side.peer = peerOf(flag, parts);
    for (const std::string& part : parts) side.text += (side.text.empty() ? "" : " ") + part;
    side.settings = resolveForDevice(settings, device, scene);
    side.isDefault = side.peer.empty() && tracesByDefault(side.settings, device, scene);
    return side;
}

std::unique_ptr<HitSource> makeSource(Device& device, const Scene& scene, const CompareSide& side) {
    if (!side.peer.empty()) return makeEmbreeCaster(scene, side.peer == "embree-robust");
    return std::make_unique<RayCaster>(device, scene, side.settings);
}

BenchView viewOf(const Scene& scene, const RenderSettings& settings) {
    return {.camera = chooseCamera(scene, settings.camera),
            .light = defaultBenchLight(scene),
            .width = static_cast<uint32_t>(settings.width),
            .height = static_cast<uint32_t>(settings.height),
            .seed = static_cast<uint32_t>(settings.seed)};
}

std::string percent(double fraction) { return std::to_string(static_cast<int>(100.0 * fraction)) + " %"; }

void judgeHits(CompareTracersRun& run) {
    const DifferenceCounts total = run.hits->total();
    const std::array<uint64_t, 2> wrong = {total.aWrong + total.bothWrong, total.bWrong + total.bothWrong};
    for (size_t i = 0; i < 2; ++i)
        if (run.sides[i].isDefault && wrong[i] > 0)
            run.failures.push_back(std::string(i == 0 ? "A" : "B") +
                                   ", the default software configuration, is wrong in " + std::to_string(wrong[i]) +
                                   " of " + std::to_string(total.rays) + " rays");
}

void compareHits(const CompareTracersOptions& options, const Scene& scene, HitSource& a, HitSource& b,
                 TimeBudget& budget, CompareTracersRun& run) {
    budget.beginStep();
    Stopwatch sinceLine;
    const auto progress = [&](double fraction) {
        if (!options.quiet && sinceLine.seconds() > kProgressInterval) {
            logInfo("first hits: " + percent(fraction));
            sinceLine.restart();
        }
        return !budget.isOver();
    };
    const ComparePlan plan{.view = viewOf(scene, run.common),
                           .rays = options.rays,
                           .offenders = options.offenders,
                           .heat = !options.heat.empty()};
    run.hits = compareRays(a, b, scene, plan, progress);
    if (!run.hits->complete)
        run.leftOut.push_back("first hits of " + std::to_string(run.hits->total().rays) + " rays, not of " +
                              std::to_string(options.rays));
    if (!options.heat.empty()) writePng(options.heat, run.hits->heat);
    judgeHits(run);
}

/// Of the mean; the rounding of hits that count as the same may move a pixel by as much as it moves t.
Bitmap varianceOfMean(const FilmImage& image, const Bitmap& other) {
    Bitmap variance = image.variance;
    for (size_t i = 0; i < variance.pixels.size(); ++i) {
        const double value = std::max(std::abs(image.mean.pixels[i]), std::abs(other.pixels[i]));
        const double count = std::max(1.0f, image.samples.pixels[i / 3]);
        variance.pixels[i] =
            static_cast<float>(static_cast<double>(variance.pixels[i]) / count + value * value * kSameT * kSameT);
    }
    return variance;
}

void writeImages(const CompareTracersOptions& options, const CompareTracersRun& run,
                 const std::array<RenderResult, 2>& results) {
    const std::filesystem::path folder = options.output;
    for (size_t i = 0; i < 2; ++i)
        for (const char* extension : {".png", ".exr"})
            writeRender(folder / ((i == 0 ? "a" : "b") + std::string(extension)), results[i], run.sides[i].settings,
                        settingsMetadata(run.sides[i].settings));
    writePng(folder / "difference.png", errorHeatMap(results[1].image.mean, results[0].image.mean));
}

void judgeImages(CompareTracersRun& run) {
    ImageComparison& images = *run.images;
    if (images.error.nonFinite > 0)
        run.failures.push_back(std::to_string(images.error.nonFinite) + " pixels are not finite");
    if (images.zTest && images.zTest->passFraction < kPassFraction)
        run.failures.push_back(
            "the images differ by more than their noise: " + std::to_string(100.0 * images.zTest->passFraction) +
            " % of the pixels pass the Z-test, " + std::to_string(100.0 * kPassFraction) + " % should");
    images.passed = images.error.nonFinite == 0 && (!images.zTest || images.zTest->passFraction >= kPassFraction);
}

void compareImagesOf(const CompareTracersOptions& options, const Scene& scene, TimeBudget& budget,
                     CompareTracersRun& run) {
    const double seconds = budget.beginStep();
    std::array<RenderResult, 2> results;
    ImageComparison images;
    for (size_t i = 0; i < 2; ++i) {
        RenderSettings settings = run.sides[i].settings;
        settings.timeLimit = 0.5 * seconds;
        if (!options.quiet) logInfo(std::string("rendering ") + (i == 0 ? "A" : "B"));
        results[i] = renderUntilDone(run.device, scene, settings, options.quiet);
        images.samples[i] = results[i].samples;
        if (results[i].stoppedBy != "samples")
            run.leftOut.push_back(std::string(i == 0 ? "A" : "B") + "'s image has " +
                                  std::to_string(results[i].samples) + " samples, not " + std::to_string(settings.spp));
    }
    const FilmImage &a = results[0].image, &b = results[1].image;
    images.error = compareImages(b.mean, a.mean);
    // With the same samples most differences cancel; the variances of few samples are too rough for others.
    if (images.samples[0] == images.samples[1] && images.samples[0] > 1)
        images.zTest = zTest(a.mean, varianceOfMean(a, b.mean), b.mean, varianceOfMean(b, a.mean));
    run.images = images;
    judgeImages(run);
    if (!options.output.empty()) writeImages(options, run, results);
}

/// One of the casters that are there already, for the benchmark.
class CasterSubject : public BenchSubject {
public:
    CasterSubject(HitSource& caster, const CompareSide& side) : caster_(caster), label_{side.peer, "", "", "", ""} {
        const RenderSettings& settings = side.settings;
        if (side.peer.empty()) label_ = {settings.tracer, settings.layout, settings.triangle, settings.builder, ""};
    }

    SubjectLabel label() const override { return label_; }
    TracedRays trace(const RaySet& set) override {
        const auto hits = set.kind.anyHit ? caster_.occluded(set.rays) : caster_.closest(set.rays);
        const auto found = std::ranges::count_if(hits, [](const shared::HitData& hit) { return hit.t >= 0.0f; });
        return {caster_.traceSeconds(), static_cast<size_t>(found)};
    }
    std::optional<RayCounters> count(const RaySet&) override { return std::nullopt; }

private:
    HitSource& caster_;
    SubjectLabel label_;
};

void timeKinds(const CompareTracersOptions& options, const Scene& scene, HitSource& a, HitSource& b, TimeBudget& budget,
               CompareTracersRun& run) {
    budget.beginStep();
    std::vector<std::unique_ptr<BenchSubject>> subjects;
    subjects.push_back(std::make_unique<CasterSubject>(a, run.sides[0]));
    subjects.push_back(std::make_unique<CasterSubject>(b, run.sides[1]));
    run.times.emplace();
    for (const RaySet& set : makeBenchRays(a, scene, viewOf(scene, run.common))) {
        if (budget.isOver()) {
            run.leftOut.push_back(std::string(set.kind.name) + " rays are not timed");
            continue;
        }
        const std::vector<BenchRow> rows = runRayBench(subjects, std::span(&set, 1), options.repeats, [] { return false; });
        if (!rows.empty()) run.times->push_back({rows[0], rows[1]});
        if (!options.quiet) logInfo("timed " + std::string(set.kind.name) + " rays");
    }
}

/// What can be wrong with the files is found before anything is measured.
void requireFiles(const CompareTracersOptions& options) {
    requireReadableFile(scenePath(options.scene));
    if (!options.heat.empty()) requireWritable(options.heat);
    if (!options.json.empty() && options.json != "-") requireWritable(options.json);
    if (!options.output.empty()) requireWritable(std::filesystem::path(options.output) / "a.png");
}

/// Images are of raylab's tracers alone; asked for by default, they are left out and said to be.
bool wantsImages(const CompareTracersOptions& options, CompareTracersRun& run) {
    const bool peers = !run.sides[0].peer.empty() || !run.sides[1].peer.empty();
    if (options.wants("images") && peers) run.leftOut.push_back("no images: Embree renders none");
    return options.wants("images") && !peers;
}

ExitCode compareTracers(const CompareTracersOptions& options) {
    setQuiet(options.quiet);
    if (!options.heat.empty() && !options.wants("hits")) throw Error("--heat shows first hits; add hits to --only");
    if (!options.output.empty() && !options.wants("images")) throw Error("-o is for the images; add images to --only");
    const RenderSettings common = commonSettings(options);
    const RenderSettings settingsA = sideSettings(common, "--a", options.a);
    const RenderSettings settingsB = sideSettings(common, "--b", options.b);
    requireFiles(options);
    Device device({common.device, common.validation});
    Scene scene = importScene(scenePath(options.scene));
    CompareTracersRun run{device,
                          options.scene,
                          common,
                          {makeSide("--a", settingsA, options.a, device.description(), scene),
                           makeSide("--b", settingsB, options.b, device.description(), scene)}};
    settleEnvironment(scene, common);
    for (const std::string& warning : scene.warnings) logWarning(warning);
    TimeBudget budget(common.timeLimit, options.only.size());
    {
        const std::unique_ptr<HitSource> a = makeSource(device, scene, run.sides[0]);
        const std::unique_ptr<HitSource> b = makeSource(device, scene, run.sides[1]);
        if (options.wants("hits")) compareHits(options, scene, *a, *b, budget, run);
        if (options.wants("time")) timeKinds(options, scene, *a, *b, budget, run);
    }
    if (wantsImages(options, run)) compareImagesOf(options, scene, budget, run);
    if (!options.json.empty()) writeJson(options.json, compareTracersJson(run));
    if (options.json != "-") {
        printCompareTracers(run);
        if (!options.heat.empty()) printHeatLegend();
    }
    return run.failures.empty() && device.validationMessageCount() == 0 ? ExitCode::done : ExitCode::checkFailed;
}

}  // namespace

void addCompareTracersCommand(CLI::App& app, Command& chosen) {
    CLI::App* command = app.add_subcommand("compare-tracers",
                                           "where two ways to trace differ, who of them is right, and which is faster");
    const auto options = std::make_shared<CompareTracersOptions>(*command);
    command->add_option("scene", options->scene, "glTF, GLB, OBJ, PLY or STL; or the name of a scene of raylab's own")
        ->required();
    const std::string side =
        "a tracer, and settings that differ from the common ones (software,layout=bvh2q), or embree or embree-robust";
    command->add_option("--a", options->a, side)
        ->type_name("TRACER,SETTING=VALUE")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->capture_default_str();
    command->add_option("--b", options->b, side)
        ->type_name("TRACER,SETTING=VALUE")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->required();
    command->add_option("--rays", options->rays, "of which first hits are compared, over all kinds of rays")
        ->check(CLI::Range(uint64_t{1}, uint64_t{1'000'000'000'000}))
        ->capture_default_str();
    command->add_option("--only", options->only, "what to do")
        ->delimiter(',')
        ->check(CLI::IsMember(std::vector<std::string>(kSteps.begin(), kSteps.end())))
        ->allow_extra_args(false)
        ->capture_default_str();
    command->add_option("-o,--output", options->output, "folder for both images and their difference")
        ->type_name("DIR");
    command->add_option("--heat", options->heat, "write a map of who is right in each pixel's primary ray as PNG")
        ->type_name("FILE");
    command->add_option("--offenders", options->offenders, "rays to list in --json")
        ->check(CLI::Range(size_t{0}, size_t{1'000'000}))
        ->capture_default_str();
    command->add_option("--repeats", options->repeats, "timed runs of each kind, after one that is not counted")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command->add_option("--json", options->json, "write everything to a file, or - for standard output")
        ->type_name("FILE");
    command->add_flag("--quiet", options->quiet, "no progress; warnings only");
    command->footer(
        "Without --width, --height and --spp: 512 x 288 pixels, 4 samples. --time-limit is for all steps "
        "together.\nExit code 1: the default software configuration is wrong in a ray that double precision "
        "can decide, or the images fail the Z-test.");
    command->callback([&chosen, options] { chosen = [options] { return compareTracers(*options); }; });
}

}  // namespace raylab
