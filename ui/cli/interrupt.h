#pragma once

#include <array>
#include <csignal>

#include "engine/core/error.h"

namespace raylab {

/// Of a command that Ctrl-C ended before all was there that was asked for; as a shell says of programs without a guard.
constexpr ExitCode kInterrupted{130};

/// Turns Ctrl-C (SIGINT, SIGTERM) into a flag while it lives, so that what is done so far can be written. A second one
/// ends the program at once.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// Since the latest guard was made.
    static bool isInterrupted();

private:
    static constexpr std::array kSignals = {SIGINT, SIGTERM};
    std::array<void (*)(int), kSignals.size()> old_{};
};

}  // namespace raylab
