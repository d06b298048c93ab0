#include <gtest/gtest.h>

#include "engine/measure/bench_compare.h"

namespace raylab {
namespace {

RecordedRow row(const std::string& tracer, double low, double median, double high) {
    return {.scene = "s", .rayKind = "primary", .tracer = tracer, .mraysPerSecond = median, .low = low, .high = high};
}

Change changeOf(const std::vector<RecordedRow>& old, const std::vector<RecordedRow>& current) {
    const std::vector<RowComparison> rows = compareRows(old, current);
    EXPECT_EQ(rows.at(0).row.tracer, "software");
    return rows.at(0).change;
}

TEST(BenchCompare, IntervalsThatOverlapAreNoChange) {
    EXPECT_EQ(changeOf({row("software", 9, 10, 11)}, {row("software", 7, 8, 9.5)}), Change::none);
    EXPECT_EQ(changeOf({row("software", 9, 10, 11)}, {row("software", 7, 8, 8.9)}), Change::slower);
    EXPECT_EQ(changeOf({row("software", 9, 10, 11)}, {row("software", 11.1, 12, 13)}), Change::faster);
}

TEST(BenchCompare, RatioHoldsTheExtremesOfBothIntervals) {
    const std::vector<RecordedRow> old{row("software", 8, 10, 16)}, current{row("software", 4, 5, 8)};
    const RowComparison comparison = compareRows(old, current).at(0);
    EXPECT_DOUBLE_EQ(comparison.ratio.value, 0.5);
    EXPECT_DOUBLE_EQ(comparison.ratio.low, 0.25);
    EXPECT_DOUBLE_EQ(comparison.ratio.high, 1.0);
    EXPECT_FALSE(comparison.normalised.has_value());
}

TEST(BenchCompare, AMachineThatBecameSlowerExplainsTheRow) {
    const std::vector<RecordedRow> old{row("software", 9, 10, 11), row("embree1", 19, 20, 21)};
    EXPECT_EQ(changeOf(old, {row("software", 4.5, 5, 5.5), row("embree1", 9.5, 10, 10.5)}), Change::none);
    EXPECT_EQ(changeOf(old, {row("software", 4.5, 5, 5.5), row("embree1", 19, 20, 21)}), Change::slower);
    // Only where both agree: the machine became faster, our row did not.
    EXPECT_EQ(changeOf(old, {row("software", 9, 10, 11), row("embree1", 38, 40, 42)}), Change::none);
}

TEST(BenchCompare, EmbreeIsNotJudged) {
    EXPECT_EQ(compareRows(std::vector{row("embree8", 9, 10, 11)}, std::vector{row("embree8", 1, 2, 3)}).at(0).change,
              Change::none);
}

TEST(BenchCompare, RowsWithoutCounterpartAreLeftOut) {
    RecordedRow other = row("software", 9, 10, 11);
    other.variation = "leaf-size=2";
    EXPECT_TRUE(compareRows(std::vector{row("software", 9, 10, 11)}, std::vector{other}).empty());
}

}  // namespace
}  // namespace raylab
