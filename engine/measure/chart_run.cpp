#include "engine/measure/chart_run.h"

#include <algorithm>
#include <limits>

#include "engine/core/stopwatch.h"
#include "engine/measure/flip.h"
#include "engine/measure/image_error.h"
#include "engine/render/lighting.h"
#include "engine/render/tonemap.h"

namespace raylab {
namespace {

/// What renderers that wait for their turn may hold; the one not used for longest goes first, and is built anew later.
constexpr size_t kMostWaitingBytes = size_t{4} << 30;
/// A level takes as much longer than the one before.
constexpr double kGrowth = 2.0;

size_t bytesOf(const Renderer& renderer) {
    return renderer.prepared().gpu->memoryBytes() + renderer.prepared().tracer->memoryBytes() + renderer.filmBytes() +
           renderer.queueBytes();
}

double flipOf(const Bitmap& image, const Bitmap& reference, const RenderSettings& settings) {
    return meanOf(flipMap(tonemapImage(image, settings.exposure, settings.tonemap),
                          tonemapImage(reference, settings.exposure, settings.tonemap)));
}

bool isOf(const ChartPoint& point, const std::string& config, uint32_t samples) {
    return point.samples == samples && point.config == config;
}

}  // namespace

uint32_t seedOfPoint(const ChartPlan& plan, int level, int repeat) {
    return plan.firstSeed + static_cast<uint32_t>(level * plan.seeds + repeat);
}

ChartRun::ChartRun(Device& device, const Scene& scene, ChartPlan plan, std::vector<const Reference*> references)
    : device_(device), scene_(scene), plan_(std::move(plan)), references_(std::move(references)) {
    levelLimits_.assign(plan_.configs.size(), plan_.levels);
    setupTimes_.resize(plan_.configs.size());
    renderers_.resize(plan_.configs.size());
}

void ChartRun::resume(const ChartTable& table, std::vector<PartialSeeds> partials) {
    table_ = table;
    partials_ = std::move(partials);
    const auto countOf = [&](const std::string& config, uint32_t samples) {
        return std::ranges::count_if(table.points, [&](const ChartPoint& p) { return isOf(p, config, samples); });
    };
    std::erase_if(partials_, [&](const PartialSeeds& partial) {
        return countOf(partial.config, partial.samples) != static_cast<std::ptrdiff_t>(partial.images.count());
    });
    std::erase_if(table_.points, [&](const ChartPoint& p) {
        if (countOf(p.config, p.samples) == plan_.seeds) return false;
        return std::ranges::none_of(
            partials_, [&](const PartialSeeds& partial) { return isOf(p, partial.config, partial.samples); });
    });
}

bool ChartRun::isMeasured(const Place& place) const {
    const uint32_t seed = seedOfPoint(plan_, place.level, place.repeat);
    return std::ranges::any_of(table_.points, [&](const ChartPoint& p) {
        return p.seed == seed && isOf(p, plan_.configs[place.config].name, samplesOfLevel(place.level));
    });
}

/// Of a configuration; of all levels for -1.
double ChartRun::secondsOf(size_t config, int level) const {
    double sum = 0.0;
    for (const ChartPoint& p : table_.points)
        if (p.config == plan_.configs[config].name && (level < 0 || p.samples == samplesOfLevel(level)))
            sum += p.wallSeconds;
    return sum;
}

int ChartRun::firstLevelOf(size_t config) const {
    const uint32_t least = leastSamples(plan_.configs[config].settings);
    int level = 0;
    while (samplesOfLevel(level) < least) ++level;
    return level;
}

bool ChartRun::fitsTimeLimit(size_t config, int level) const {
    if (plan_.timeLimit <= 0.0 || level == firstLevelOf(config)) return true;
    const double share = plan_.timeLimit / static_cast<double>(plan_.configs.size());
    return secondsOf(config, -1) + kGrowth * secondsOf(config, level - 1) <= share;
}

std::optional<ChartRun::Place> ChartRun::nextPlace() {
    for (int level = 0; level < plan_.levels; ++level)
        for (int repeat = 0; repeat < plan_.seeds; ++repeat)
            for (size_t i = 0; i < plan_.configs.size(); ++i) {
                const size_t config = repeat % 2 == 0 ? i : plan_.configs.size() - 1 - i;
                const Place place{level, repeat, config};
                if (level < firstLevelOf(config) || level >= levelLimits_[config] || isMeasured(place)) continue;
                const bool begins = std::ranges::none_of(table_.points, [&](const ChartPoint& p) {
                    return isOf(p, plan_.configs[config].name, samplesOfLevel(level));
                });
                if (!begins || fitsTimeLimit(config, level)) return place;
                levelLimits_[config] = level;
            }
    return std::nullopt;
}

/// False where it was stopped, or took longer than `limit` seconds.
bool ChartRun::render(Renderer& renderer, uint32_t seed, uint32_t samples, double limit,
                      const std::function<bool()>& stop) {
    renderer.restart(seed, samples);
    const Stopwatch watch;
    while (renderer.step())
        if (stop() || watch.seconds() > limit) return false;
    return true;
}

Renderer& ChartRun::rendererOf(size_t config, const std::function<bool()>& stop) {
    std::erase(recentlyUsed_, config);
    recentlyUsed_.push_back(config);
    if (renderers_[config]) return *renderers_[config];
    size_t waiting = 0;
    for (size_t i = recentlyUsed_.size() - 1; i-- > 0;) {
        std::unique_ptr<Renderer>& other = renderers_[recentlyUsed_[i]];
        if (other) waiting += bytesOf(*other);
        if (waiting > kMostWaitingBytes) other.reset();
    }
    RenderSettings settings = plan_.configs[config].settings;
    const uint32_t least = samplesOfLevel(firstLevelOf(config));
    settings.spp = least;
    Scene settled = scene_;
    settleEnvironment(settled, settings);
    renderers_[config] = std::make_unique<Renderer>(device_, settled, settings);
    setupTimes_[config] = renderers_[config]->times();
    render(*renderers_[config], plan_.firstSeed, least, std::numeric_limits<double>::infinity(), stop);
    renderers_[config]->develop(stop);  // a denoiser's kernels are made now
    return *renderers_[config];
}

std::optional<ChartShot> ChartRun::next(const std::function<bool()>& stop) {
    while (const std::optional<Place> place = nextPlace()) {
        Renderer& renderer = rendererOf(place->config, stop);
        const double share = plan_.timeLimit > 0.0 ? plan_.timeLimit / static_cast<double>(plan_.configs.size())
                                                   : std::numeric_limits<double>::infinity();
        const uint32_t seed = seedOfPoint(plan_, place->level, place->repeat);
        if (!stop() && render(renderer, seed, samplesOfLevel(place->level), share, stop)) {
            Bitmap image = renderer.develop(stop).picture();
            if (stop()) return std::nullopt;
            addPoint(*place, renderer, image);
            return ChartShot{place->config, place->level, place->repeat, std::move(image)};
        }
        if (stop()) return std::nullopt;
        levelLimits_[place->config] = place->level;
    }
    return std::nullopt;
}

void ChartRun::addPoint(const Place& place, Renderer& renderer, const Bitmap& image) {
    const ChartConfig& config = plan_.configs[place.config];
    const Bitmap& reference = references_[place.config]->image.mean;
    const ImageError error = compareImages(image, reference);
    table_.points.push_back({.config = config.name,
                             .seed = seedOfPoint(plan_, place.level, place.repeat),
                             .samples = samplesOfLevel(place.level),
                             .deviceSeconds = renderer.times().device + renderer.times().denoiseDevice,
                             .wallSeconds = renderer.times().render + renderer.times().denoise,
                             .rmse = error.rmse,
                             .relMse = error.relMse,
                             .flip = flipOf(image, reference, config.settings)});
    addImage(place, image);
}

/// With the last of the seeds their sum becomes an estimate of the bias.
void ChartRun::addImage(const Place& place, const Bitmap& image) {
    const std::string& name = plan_.configs[place.config].name;
    const uint32_t samples = samplesOfLevel(place.level);
    auto partial = std::ranges::find_if(
        partials_, [&](const PartialSeeds& p) { return p.samples == samples && p.config == name; });
    if (partial == partials_.end())
        partial = partials_.insert(partial, {name, samples, SeedImages(image.width, image.height, image.channels)});
    partial->images.add(image);
    if (partial->images.count() < static_cast<uint32_t>(plan_.seeds)) return;
    const ReferenceImage& reference = references_[place.config]->image;
    const Bitmap weights = errorWeights(reference.mean, plan_.measure != ErrorMeasure::rmse);
    table_.biases.push_back({name, samples, partial->images.estimate(reference, weights)});
    partials_.erase(partial);
}

double ChartRun::fractionDone() const {
    // Seconds grow with samples: so does what is left.
    double all = 0.0, done = 0.0;
    for (size_t config = 0; config < plan_.configs.size(); ++config)
        for (int level = firstLevelOf(config); level < levelLimits_[config]; ++level)
            for (int repeat = 0; repeat < plan_.seeds; ++repeat) {
                all += samplesOfLevel(level);
                if (isMeasured({level, repeat, config})) done += samplesOfLevel(level);
            }
    return all > 0.0 ? done / all : 1.0;
}

}  // namespace raylab
