#pragma once

#include <string>

namespace raylab {

/// One line to standard error. Standard output is kept for results.
void logInfo(const std::string& message);
void logWarning(const std::string& message);
void logError(const std::string& message);

/// `true` keeps warnings and errors only.
void setQuiet(bool quiet);

}  // namespace raylab
