#pragma once

#include <functional>
#include <string>

namespace raylab {

/// One line to standard error. Standard output is kept for results.
void logInfo(const std::string& message);
void logWarning(const std::string& message);
void logError(const std::string& message);

enum class LogLevel { info, warning, error };

/// Hears every line besides standard error, from any thread, one at a time; it must not log. Empty: nobody does.
void setLogListener(std::function<void(LogLevel, const std::string&)> listener);

/// `true` keeps warnings and errors only.
void setQuiet(bool quiet);

}  // namespace raylab
