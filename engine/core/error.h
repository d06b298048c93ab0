#pragma once

#include <stdexcept>
#include <string>

namespace raylab {

/// Exit codes of every subcommand; other programs rely on them.
enum class ExitCode : int {
    done = 0,
    checkFailed = 1,    ///< the check or comparison that was asked for failed
    badInput = 2,       ///< bad input or usage
    noDevice = 3,       ///< no suitable device
    internalError = 4,  ///< our own mistake, or the driver's
};

/// A mistake of the user's, or of the world's: what() names the file (and line where known) and says what to do.
class Error : public std::runtime_error {
public:
    explicit Error(const std::string& message, ExitCode exitCode = ExitCode::badInput)
        : std::runtime_error(message), exitCode_(exitCode) {}
    ExitCode exitCode() const { return exitCode_; }

private:
    ExitCode exitCode_;
};

}  // namespace raylab
