#include "engine/measure/log_axis.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace raylab {
namespace {

TEST(LogAxis, HoldsItsValuesWithRoom) {
    const std::array values{0.003, 12.0, 0.5};
    const LogAxis axis = logAxisAround(values);
    for (const double value : values) {
        EXPECT_GT(axis.partOf(value), 0.0);
        EXPECT_LT(axis.partOf(value), 1.0);
        EXPECT_NEAR(axis.valueAt(axis.partOf(value)), value, 1e-12 * value);
    }
    // Equal ratios are equal ways.
    EXPECT_NEAR(axis.partOf(0.1) - axis.partOf(0.01), axis.partOf(10.0) - axis.partOf(1.0), 1e-12);
}

TEST(LogAxis, LeavesOutWhatHasNoLogarithm) {
    const std::array values{
        1.0, 10.0, 0.0, -3.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
    const LogAxis axis = logAxisAround(values);
    EXPECT_GT(axis.low, -0.2);
    EXPECT_LT(axis.high, 1.2);
    const LogAxis none = logAxisAround(std::span<const double>());
    EXPECT_LT(none.low, none.high);
}

TEST(LogAxis, LabelsPowersAndMoreWhereTheseAreFew) {
    int labelled = 0;
    for (const LogTick& tick : logTicks({-2.0, 3.0}))
        if (tick.isLabelled) {
            EXPECT_NEAR(std::log10(tick.value), std::round(std::log10(tick.value)), 1e-9);
            ++labelled;
        }
    EXPECT_EQ(labelled, 6);  // .01 .1 1 10 100 1000
    labelled = 0;
    for (const LogTick& tick : logTicks({0.0, 1.0})) labelled += tick.isLabelled ? 1 : 0;
    EXPECT_EQ(labelled, 4);  // 1 2 5 10
    EXPECT_EQ(logTicks({0.0, 1.0}).size(), 10u);
}

}  // namespace
}  // namespace raylab
