#pragma once

#include <string>
#include <vector>

namespace raylab {

struct ProcessResult {
    int exitCode = 0;    ///< 128 + the signal's number where one ended it
    std::string output;  ///< standard output and standard error together
};

/// Runs a program to its end: `words[0]` is a path, or a name that is looked for in PATH; no shell sees them. Throws
/// Error where it cannot be started.
ProcessResult runProcess(const std::vector<std::string>& words);

}  // namespace raylab
