#include "ui/editor/advice_feed.h"

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "ui/editor/measured_scene.h"
#include "ui/report/settings_file.h"

namespace raylab {
namespace {

std::shared_ptr<const AdviceReport> search(const Scene& scene, const std::string& name, const RenderSettings& settings,
                                           const AdviceGoal& goal, AdviceFeed& feed, JobControl& control) {
    const auto tell = [&](const std::string& what) {
        feed.setDoing(what);
        control.report("Advice: " + what);
    };
    Device device({settings.device, settings.validation});
    AdviceReport report;
    const bool isDone =
        runAdvice(device, name, scene, settings, goal, 0.0,
                  {.stop = [&] { return control.isCancelled(); },
                   .onReference = [&](double done) { tell(progressText("rendering the reference", done)); },
                   .onProgress = tell},
                  report);
    return isDone ? std::make_shared<const AdviceReport>(std::move(report)) : nullptr;
}

}  // namespace

AdviceFeed::View AdviceFeed::view() const {
    const std::lock_guard lock(mutex_);
    return view_;
}

void AdviceFeed::begin() {
    const std::lock_guard lock(mutex_);
    view_ = {};
    view_.running = true;
}

void AdviceFeed::setDoing(const std::string& what) {
    const std::lock_guard lock(mutex_);
    view_.doing = what;
}

void AdviceFeed::end(std::shared_ptr<const AdviceReport> report) {
    const std::lock_guard lock(mutex_);
    view_.running = false;
    view_.report = std::move(report);
}

void AdviceFeed::fail(const std::string& error) {
    const std::lock_guard lock(mutex_);
    view_.running = false;
    view_.error = error;
}

void startAdvice(EditorContext& context, const AdviceGoal& goal, int width, const std::shared_ptr<AdviceFeed>& feed) {
    const MeasuredScene measured = measuredScene(context);
    const RenderSettings& document = context.state.settings();
    const RenderSettings settings = measuredSettings(document, document, measured.camera, width);
    feed->begin();
    context.measuring.start("Advice",
                            [scene = measured.scene, name = context.state.document->file().string(), settings, goal,
                             feed](JobControl& control) -> Background::Finish {
                                try {
                                    feed->end(search(*scene, name, settings, goal, *feed, control));
                                } catch (const std::exception& error) {
                                    feed->fail(error.what());
                                    throw;
                                }
                                return [] {};
                            });
}

void adoptAdvice(EditorContext& context, const AdviceReport& report) {
    RenderSettings settings = context.state.settings();
    for (const AdviceStep& step : report.advice.steps) {
        const Setting<RenderSettings>& setting = findSetting(renderSettingsTable(), step.setting);
        setSetting(setting, settings, settingText(getSetting(setting, report.advice.settings)));
    }
    settings.spp = report.advice.settings.spp;
    applyEdit(context, {"Adopt the advice", [settings](editor::EditState& state) { state.settings = settings; }});
}

void saveAdvice(EditorContext& context, const std::shared_ptr<const AdviceReport>& report, const std::string& file) {
    context.background.start("Writing " + file, [report, file](JobControl&) -> Background::Finish {
        writeJson(file, presetJson(*report));
        logInfo("preset: " + std::filesystem::absolute(file).string());
        return [] {};
    });
}

}  // namespace raylab
