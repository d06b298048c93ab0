#include "ui/cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>

namespace raylab {
namespace {

constexpr double kTerminalInterval = 0.1;
constexpr double kPlainInterval = 5.0;
constexpr int kBarWidth = 28;

}  // namespace

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) != 0) {}

std::string Progress::line(double fraction, uint32_t samples, double noise) const {
    std::string text;
    if (terminal_) {
        const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kBarWidth);
        text = "[" + std::string(static_cast<size_t>(filled), '#') + std::string(static_cast<size_t>(kBarWidth - filled), '.') + "] ";
    }
    std::array<char, 96> buffer{};
    const double left = fraction > 0.0 ? watch_.seconds() * (1.0 - fraction) / fraction : 0.0;
    std::snprintf(buffer.data(), buffer.size(), "%3.0f%%  %u samples  %.0f s left", 100.0 * fraction, samples, left);
    text += buffer.data();
    if (noise >= 0.0) {
        std::snprintf(buffer.data(), buffer.size(), "  noise %.2f%%", 100.0 * noise);
        text += buffer.data();
    }
    return text;
}

void Progress::show(double fraction, uint32_t samples, double noise) {
    if (quiet_ || watch_.seconds() < nextShow_) return;
    nextShow_ = watch_.seconds() + (terminal_ ? kTerminalInterval : kPlainInterval);
    const std::string text = line(fraction, samples, noise);
    std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", text.c_str());
    drawn_ = true;
}

void Progress::finish() {
    if (drawn_ && terminal_) std::fprintf(stderr, "\n");
    drawn_ = false;
}

}  // namespace raylab
