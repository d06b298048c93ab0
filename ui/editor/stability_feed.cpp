#include "ui/editor/stability_feed.h"

#include <array>

#include "engine/core/file.h"
#include "engine/render/device_recovery.h"
#include "ui/report/stability_plan.h"

namespace raylab {
namespace {

void runOrder(const StabilityOrder& order, const RenderSettings& machine, StabilityFeed& feed, JobControl& control) {
    ReplaceableDevice device({machine.device, machine.validation});
    const std::array sets = {order.configs};
    const stability::Plan plan = stabilityPlan(order.ids, sets, device.get().description());
    const auto replaceDevice = [&] {
        device.replace();
        return &device.get();
    };
    const stability::Context context{device.get(),
                                     {},
                                     order.quick,
                                     sharedScenes(),
                                     executableFolder() / "raylab",
                                     [&] { return !control.isCancelled(); },
                                     replaceDevice};
    const stability::BatteryResult result = stability::runBattery(
        plan, context,
        [&](const stability::Case& which, const stability::Config& config, std::span<const stability::Row> rows) {
            feed.add(rows);
            control.report("Stability " + std::string(which.id) + ": " + std::string(which.provokes) + ", " +
                           config.name);
        });
    feed.end(result.complete);
}

}  // namespace

StabilityFeed::View StabilityFeed::view() const {
    const std::lock_guard lock(mutex_);
    return view_;
}

void StabilityFeed::begin() {
    const std::lock_guard lock(mutex_);
    view_ = {};
    view_.running = true;
}

void StabilityFeed::add(std::span<const stability::Row> rows) {
    Rows added;
    for (const stability::Row& row : rows) added.push_back(std::make_shared<const stability::Row>(row));
    const std::lock_guard lock(mutex_);
    view_.rows.insert(view_.rows.end(), added.begin(), added.end());
}

void StabilityFeed::end(bool complete) {
    const std::lock_guard lock(mutex_);
    view_.running = false;
    view_.complete = complete;
}

void StabilityFeed::fail(const std::string& error) {
    const std::lock_guard lock(mutex_);
    view_.running = false;
    view_.error = error;
}

void startStability(EditorContext& context, const StabilityOrder& order, const std::shared_ptr<StabilityFeed>& feed) {
    feed->begin();
    context.measuring.start(
        "Stability", [order, machine = context.state.settings(), feed](JobControl& control) -> Background::Finish {
            try {
                runOrder(order, machine, *feed, control);
            } catch (const std::exception& error) {
                feed->fail(error.what());
                throw;
            }
            return [] {};
        });
}

}  // namespace raylab
