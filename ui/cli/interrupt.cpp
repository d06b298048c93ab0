#include "ui/cli/interrupt.h"

namespace raylab {
namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

InterruptGuard::InterruptGuard() {
    interrupted = 0;
    for (size_t i = 0; i < kSignals.size(); ++i) old_[i] = std::signal(kSignals[i], [](int) { interrupted = 1; });
}

InterruptGuard::~InterruptGuard() {
    for (size_t i = 0; i < kSignals.size(); ++i) std::signal(kSignals[i], old_[i]);
}

bool InterruptGuard::isInterrupted() { return interrupted != 0; }

}  // namespace raylab
