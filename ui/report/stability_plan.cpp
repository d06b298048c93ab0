#include "ui/report/stability_plan.h"

#include <algorithm>

#include "engine/core/file.h"

namespace raylab {

namespace fs = std::filesystem;

fs::path sharedScenes() {
    for (fs::path folder = executableFolder(); folder.has_relative_path(); folder = folder.parent_path())
        if (fs::exists(folder / "CMakePresets.json")) {
            const fs::path beside = folder / "../shared/scenes";
            return fs::is_directory(beside) ? beside : fs::path();
        }
    return {};
}

stability::Plan stabilityPlan(std::span<const std::string> ids, std::span<const std::string> sets,
                              const DeviceDescription& device) {
    stability::Plan plan;
    for (const std::string& id : ids)
        for (const stability::Case* each : stability::casesOf(id)) plan.cases.push_back(each);
    if (ids.empty())
        for (const stability::Case& each : stability::cases()) plan.cases.push_back(&each);
    for (const std::string& set : sets)
        for (const stability::Config& config : stability::configsOf(set, device))
            if (std::ranges::find(plan.configs, config.name, &stability::Config::name) == plan.configs.end())
                plan.configs.push_back(config);
    return plan;
}

}  // namespace raylab
