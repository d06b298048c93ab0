#include "engine/core/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <mutex>
#include <utility>

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

using Listener = std::function<void(LogLevel, const std::string&)>;

struct Listening {
    std::mutex mutex;
    Listener listener;
};

Listening& listening() {
    static Listening instance;
    return instance;
}

void tellListener(LogLevel level, const std::string& message) {
    const std::lock_guard lock(listening().mutex);
    if (listening().listener) listening().listener(level, message);
}

}  // namespace

void logInfo(const std::string& message) {
    logger().info(message);
    tellListener(LogLevel::info, message);
}

void logWarning(const std::string& message) {
    logger().warn("warning: " + message);
    tellListener(LogLevel::warning, message);
}

void logError(const std::string& message) {
    logger().error("error: " + message);
    tellListener(LogLevel::error, message);
}

void setLogListener(Listener listener) {
    const std::lock_guard lock(listening().mutex);
    listening().listener = std::move(listener);
}

void setQuiet(bool quiet) { logger().set_level(quiet ? spdlog::level::warn : spdlog::level::info); }

}  // namespace raylab
