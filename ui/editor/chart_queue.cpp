#include "ui/editor/chart_queue.h"

#include <algorithm>
#include <array>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "ui/editor/measured_scene.h"
#include "ui/report/chart_output.h"

namespace raylab {
namespace {

/// What a chart chooses for all of its configurations, and what is of the machine.
constexpr std::array kChosen = {"width",      "height",     "spp",          "seed",   "camera",
                                "camera-end", "time-limit", "target-error", "device", "validation"};
/// What makes another display of the same radiance.
constexpr std::array kShown = {"exposure", "tonemap"};

template <class List>
bool holds(const List& list, std::string_view name) {
    return std::ranges::find(list, name) != list.end();
}

bool isOfMethod(std::string_view name) { return !holds(kChosen, name) && !holds(kShown, name); }

ChartOrder orderOf(const EditorContext& context, const ChartQueue& queue, const std::string& camera,
                   double targetError) {
    const RenderSettings& document = context.state.settings();
    ChartOrder order{.scene = context.state.document->file().string(),
                     .folder = {},
                     .configs = queue.configs,
                     .seeds = queue.seeds,
                     .levels = queue.levels,
                     .firstSeed = static_cast<uint32_t>(document.seed),
                     .timeLimit = queue.seconds,
                     .targetError = targetError,
                     .measure = queue.measure,
                     .reference = queue.reference,
                     .referenceError = queue.referenceError};
    for (ChartConfig& config : order.configs)
        config.settings = measuredSettings(config.settings, document, camera, queue.width);
    return order;
}

void measureChart(const Scene& scene, const ChartOrder& order, ChartFeed& feed, JobControl& control) {
    const RenderSettings& first = order.configs.front().settings;
    Device device({first.device, first.validation});
    const ChartWatch watch{.stop = [&] { return control.isCancelled(); },
                           .onReference =
                               [&](double done) {
                                   feed.setDone(done);
                                   control.report(progressText("Chart: rendering the reference", done));
                               },
                           .onPoint =
                               [&](const Chart& chart, const ChartShot& shot, double done) {
                                   feed.add(chart, shot, done);
                                   control.report(progressText("Chart: measuring", done));
                               }};
    Chart chart = runChart(device, scene, order, watch);
    const std::string loss = chart.deviceLoss;
    feed.end(std::move(chart));
    if (!loss.empty()) throw Error(loss);
    if (device.validationMessageCount() > 0) throw Error("the chart made the validation layers complain");
}

}  // namespace

std::string configName(const RenderSettings& settings) {
    std::string name;
    for (const Setting<RenderSettings>& row : renderSettingsTable()) {
        const SettingValue value = getSetting(row, settings);
        if (!isOfMethod(row.name) || value == getSetting(row, RenderSettings{})) continue;
        name += (name.empty() ? "" : " ") + std::string(row.name) + "=" + settingText(value);
    }
    return name.empty() ? "default" : name;
}

bool isSameMethod(const RenderSettings& a, const RenderSettings& b) {
    return std::ranges::all_of(renderSettingsTable(), [&](const Setting<RenderSettings>& row) {
        return !isOfMethod(row.name) || getSetting(row, a) == getSetting(row, b);
    });
}

void addToQueue(ChartQueue& queue, const std::vector<ChartConfig>& configs) {
    for (ChartConfig config : configs) {
        const auto isKnown = [&](const ChartConfig& other) { return isSameMethod(other.settings, config.settings); };
        if (std::ranges::any_of(queue.configs, isKnown)) continue;
        const std::string name = config.name;
        for (int i = 2; std::ranges::find(queue.configs, config.name, &ChartConfig::name) != queue.configs.end(); ++i)
            config.name = name + " (" + std::to_string(i) + ")";
        queue.configs.push_back(std::move(config));
    }
}

RenderSettings adoptedSettings(const RenderSettings& document, const RenderSettings& config, uint32_t samples) {
    RenderSettings settings = document;
    for (const Setting<RenderSettings>& row : renderSettingsTable())
        if (isOfMethod(row.name)) std::visit([&](auto member) { settings.*member = config.*member; }, row.member);
    settings.spp = samples;
    return settings;
}

void startChart(EditorContext& context, const ChartQueue& queue, double targetError,
                const std::shared_ptr<ChartFeed>& feed) {
    const MeasuredScene measured = measuredScene(context);
    ChartOrder order = orderOf(context, queue, measured.camera, targetError);
    feed->begin();
    context.measuring.start(
        "Chart", [scene = measured.scene, order = std::move(order), feed](JobControl& control) -> Background::Finish {
            try {
                measureChart(*scene, order, *feed, control);
            } catch (const std::exception& error) {
                feed->fail(control.isCancelled() ? "cancelled" : error.what());
                if (!control.isCancelled()) throw;
            }
            return [] {};
        });
}

void exportChart(EditorContext& context, const std::shared_ptr<ChartFeed>& feed, const std::string& folder) {
    const std::shared_ptr<const Chart> chart = feed->view().chart;
    context.background.start("Writing the chart",
                             [chart, pictures = feed->pictures(), folder](JobControl&) -> Background::Finish {
                                 Chart copy = *chart;
                                 copy.folder = folder;
                                 requireWritable(copy.csvFile());
                                 loadEarlier(copy);
                                 for (const auto& [which, picture] : pictures)
                                     writePictures(copy, which.first, which.second, *picture);
                                 writeChart(copy);
                                 logInfo("chart: " + std::filesystem::absolute(copy.folder / "report.html").string());
                                 return [] {};
                             });
}

}  // namespace raylab
