#include "engine/measure/log_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylab {
namespace {

constexpr double kRoom = 0.04;        ///< of the axis, beyond the values at each end
constexpr double kLeastRoom = 0.05;   ///< decades
constexpr double kFewDecades = 2.5;   ///< below, 2 and 5 times the powers of ten have labels
constexpr double kPartDecades = 0.5;  ///< below, all ticks have

}  // namespace

double LogAxis::partOf(double value) const { return (std::log10(value) - low) / (high - low); }

double LogAxis::valueAt(double part) const { return std::pow(10.0, low + part * (high - low)); }

LogAxis logAxisAround(std::span<const double> values) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    double least = kInfinity, most = 0.0;
    for (const double value : values) {
        if (!std::isfinite(value) || value <= 0.0) continue;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    if (least > most) return {};
    const double low = std::log10(least), high = std::log10(most);
    const double room = std::max(kRoom * (high - low), kLeastRoom);
    return {low - room, high + room};
}

std::vector<LogTick> logTicks(const LogAxis& axis) {
    constexpr double kSlack = 1e-9;
    std::vector<LogTick> ticks;
    const double decades = axis.high - axis.low;
    for (int power = static_cast<int>(std::floor(axis.low)); power <= axis.high; ++power)
        for (int digit = 1; digit < 10; ++digit) {
            const double value = digit * std::pow(10.0, power), place = std::log10(value);
            if (place < axis.low - kSlack || place > axis.high + kSlack) continue;
            const bool isHalf = decades < kFewDecades && (digit == 2 || digit == 5);
            ticks.push_back({value, digit == 1 || isHalf || decades < kPartDecades});
        }
    return ticks;
}

}  // namespace raylab
