#include "ui/report/chart_job.h"

#include <map>

#include "engine/accel/bvh_cache.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/gpu/check.h"
#include "engine/measure/scene_hash.h"
#include "ui/report/chart_output.h"
#include "ui/report/settings_file.h"

namespace raylab {
namespace {

bool isFile(const std::string& reference) { return reference != "path" && reference != "own"; }

/// The references of a chart, each rendered or read once.
class References {
public:
    References(Device& device, const Scene& scene, const ChartOrder& order, const ChartWatch& watch)
        : device_(device), scene_(scene), order_(order), watch_(watch) {}

    std::shared_ptr<const Reference> of(const RenderSettings& settings) {
        const RenderSettings wanted =
            referenceSettings(settings, order_.reference == "own" ? ReferenceKind::own : ReferenceKind::path);
        const std::string key = isFile(order_.reference)
                                    ? std::to_string(settings.width) + "x" + std::to_string(settings.height)
                                    : settingsJson(wanted).dump();
        std::shared_ptr<const Reference>& known = known_[key];
        if (known == nullptr)
            known = std::make_shared<const Reference>(
                isFile(order_.reference) ? readReference(order_.reference, static_cast<int>(settings.width),
                                                         static_cast<int>(settings.height))
                                         : render(wanted));
        return known;
    }

private:
    Reference render(const RenderSettings& settings) {
        logInfo("reference: " + order_.reference + ", to a relative error of " + settingText(order_.referenceError));
        std::optional<Reference> reference = obtainReference(device_, scene_, settings, order_.referenceError,
                                                             referenceFolder(), watch_.stop, watch_.onReference);
        if (!reference) throw Error("interrupted while the reference was rendered; nothing was measured yet");
        return std::move(*reference);
    }

    Device& device_;
    const Scene& scene_;
    const ChartOrder& order_;
    const ChartWatch& watch_;
    std::map<std::string, std::shared_ptr<const Reference>> known_;
};

/// What tells one choice of reference from another: a file by its bytes.
std::string referenceIdentity(const std::string& choice) {
    if (!isFile(choice)) return choice;
    const Hash128 hash = hashBytes(readFile(choice));
    return "file " + std::to_string(hash.high) + " " + std::to_string(hash.low);
}

Chart makeChart(const ChartOrder& order, const Scene& scene, const DeviceDescription& device) {
    Chart chart;
    chart.folder = order.folder;
    chart.scene = order.scene;
    chart.sceneHash = sceneHash(scene);
    chart.device = device.name;
    chart.referenceChoice = referenceIdentity(order.reference);
    chart.referenceError = order.referenceError;
    chart.targetError = order.targetError;
    chart.plan = {.configs = order.configs,
                  .seeds = order.seeds,
                  .levels = order.levels,
                  .firstSeed = order.firstSeed,
                  .timeLimit = order.timeLimit,
                  .measure = order.measure};
    return chart;
}

/// The table on disk follows each point.
void measurePoints(ChartRun& run, Chart& chart, const ChartWatch& watch) {
    const bool hasFolder = !chart.folder.empty();
    while (const std::optional<ChartShot> shot = run.next(watch.stop)) {
        chart.table = run.table();
        analyse(chart);
        if (hasFolder) writeChartCsv(chart);
        if (hasFolder && shot->repeat == 0)
            writePictures(chart, shot->config, samplesOfLevel(shot->level), makePictures(chart, *shot));
        watch.onPoint(chart, *shot, run.fractionDone());
    }
}

/// Measures until all is done, the watch says stop or the device is lost.
void measure(ChartRun& run, Chart& chart, const ChartWatch& watch) {
    try {
        measurePoints(run, chart, watch);
    } catch (const DeviceLost& loss) {
        chart.deviceLoss = loss.what();
    }
    chart.table = run.table();
    chart.partials = run.partials();
    chart.levelLimits = run.levelLimits();
    chart.setupTimes = run.setupTimes();
    chart.isInterrupted = watch.stop() || !chart.deviceLoss.empty();
    analyse(chart);
}

}  // namespace

Chart runChart(Device& device, const Scene& scene, const ChartOrder& order, const ChartWatch& watch) {
    Chart chart = makeChart(order, scene, device.description());
    const std::optional<EarlierChart> earlier = order.folder.empty() ? std::nullopt : loadEarlier(chart);
    References references(device, scene, order, watch);
    std::vector<const Reference*> judges;
    for (const ChartConfig& config : chart.plan.configs) {
        chart.references.push_back(references.of(config.settings));
        judges.push_back(chart.references.back().get());
    }
    ChartRun run(device, scene, chart.plan, judges);
    if (earlier) run.resume(earlier->table, earlier->partials);
    if (!order.folder.empty()) writeChartJson(chart);
    measure(run, chart, watch);
    if (!order.folder.empty()) writeChart(chart);
    return chart;
}

}  // namespace raylab
