#include "engine/core/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace raylab {
namespace {

spdlog::logger& logger() {
    static const std::shared_ptr<spdlog::logger> instance = [] {
        auto created = spdlog::stderr_color_mt("raylab");
        created->set_pattern("%^%v%$");
        return created;
    }();
    return *instance;
}

}  // namespace

void logInfo(const std::string& message) { logger().info(message); }
void logWarning(const std::string& message) { logger().warn("warning: " + message); }
void logError(const std::string& message) { logger().error("error: " + message); }
void setQuiet(bool quiet) { logger().set_level(quiet ? spdlog::level::warn : spdlog::level::info); }

}  // namespace raylab
