#include "ui/cli/interrupt.h"

namespace raylab {
namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

InterruptGuard::InterruptGuard() {
    interrupted = 0;
    const auto onSignal = [](int signal) {
        interrupted = 1;
        std::signal(signal, SIG_DFL);
    };
    for (size_t i = 0; i < kSignals.size(); ++i) old_[i] = std::signal(kSignals[i], onSignal);
}

InterruptGuard::~InterruptGuard() {
    for (size_t i = 0; i < kSignals.size(); ++i) std::signal(kSignals[i], old_[i]);
}

bool InterruptGuard::isInterrupted() { return interrupted != 0; }

}  // namespace raylab
