#pragma once

#include <array>
#include <csignal>

namespace raylab {

/// Turns Ctrl-C (SIGINT, SIGTERM) into a flag while it lives, so that what is done so far can be written.
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
