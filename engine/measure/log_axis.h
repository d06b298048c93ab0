#pragma once

#include <span>
#include <vector>

namespace raylab {

/// A logarithmic axis of a chart, by the decimal logarithms of its ends.
struct LogAxis {
    double low = 0.0;
    double high = 1.0;

    /// Where a positive value lies: 0 at the low end, 1 at the high one.
    double partOf(double value) const;
    /// The value at a part of the axis.
    double valueAt(double part) const;
};

/// Around values, with some room; those that are not finite and positive are left out. One decade from 1 where none is
/// left.
LogAxis logAxisAround(std::span<const double> values);

struct LogTick {
    double value = 0.0;
    bool isLabelled = false;
};

/// Every 1, 2, .. 9 times a power of ten within the axis. Labelled are the powers of ten; where these are few, 2 and 5
/// times them too; where there is less than half of a decade, all.
std::vector<LogTick> logTicks(const LogAxis& axis);

}  // namespace raylab
