#include "engine/measure/stability/battery.h"

#include <cmath>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/gpu/check.h"

namespace raylab::stability {
namespace {

Row emptyRow(const Case& which, const Config& config) {
    Row row;
    row.id = which.id;
    row.provokes = which.provokes;
    row.config = config.name;
    row.isDefault = config.isDefault();
    return row;
}

Row skippedRow(const Case& which, const Config& config, const std::string& why) {
    Row row = emptyRow(which, config);
    row.skipped = why;
    return row;
}

Row failedRow(const Case& which, const Config& config, const std::string& why) {
    Row row = emptyRow(which, config);
    row.number = {"the case ran to its end", std::nan(""), 0.0, "", why, std::nullopt};
    return row;
}

/// `isLost`: whether the device is lost, and no case works on it any more.
std::vector<Row> runCase(const Case& which, const Config& config, const Context& context, bool& isLost) {
    std::vector<Row> rows;
    if (!config.missing.empty()) return {skippedRow(which, config, "the device lacks " + config.missing)};
    try {
        for (Number& number : which.measure(context)) {
            rows.push_back(emptyRow(which, config));
            rows.back().number = std::move(number);
        }
    } catch (const Skipped& skipped) {
        rows = {skippedRow(which, config, skipped.what())};
    } catch (const DeviceLost& loss) {
        isLost = true;
        rows = {failedRow(which, config, loss.what())};
    } catch (const Error& error) {
        rows = {failedRow(which, config, error.what())};
    }
    return rows;
}

Context contextOn(Device& device, const Config& config, const Context& context) {
    return {device,          config.settings, context.quick,        context.scenes,
            context.program, context.goesOn,  context.replaceDevice};
}

}  // namespace

void Context::check() const {
    if (goesOn && !goesOn()) throw Stopped("stopped");
}

std::filesystem::path Context::sceneFile(const std::string& relativePath) const {
    const std::filesystem::path path = scenes / relativePath;
    if (scenes.empty() || !std::filesystem::exists(path))
        throw Skipped("needs " + relativePath + " of the shared scenes (--scenes DIR)");
    return path;
}

std::vector<const Case*> casesOf(std::string_view id) {
    std::vector<const Case*> found;
    std::string known;
    for (const Case& each : cases()) {
        if (each.id == id) found.push_back(&each);
        if (known.find(std::string(each.id) + ",") == std::string::npos) known += std::string(each.id) + ", ";
    }
    if (found.empty())
        throw Error("there is no case '" + std::string(id) + "'; there are " + known.substr(0, known.size() - 2));
    return found;
}

BatteryResult runBattery(const Plan& plan, const Context& context, const BatteryProgress& progress) {
    BatteryResult result;
    Device* device = &context.device;
    try {
        for (const Case* each : plan.cases)
            for (const Config& config : plan.configs) {
                if (!config.isDefault() && (config.axes & each->axes) != config.axes) continue;
                context.check();
                progress(*each, config, {});
                const Stopwatch watch;
                bool isLost = false;
                std::vector<Row> rows = runCase(*each, config, contextOn(*device, config, context), isLost);
                for (Row& row : rows) row.seconds = watch.seconds();
                progress(*each, config, rows);
                for (Row& row : rows) result.rows.push_back(std::move(row));
                if (isLost && !context.replaceDevice) throw Stopped("the device is lost");
                if (isLost) device = context.replaceDevice();
            }
    } catch (const Stopped&) {
        result.complete = false;
    }
    return result;
}

}  // namespace raylab::stability
