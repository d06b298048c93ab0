#include "engine/measure/bench_compare.h"

#include <algorithm>

namespace raylab {
namespace {

Ratio ratioOf(const RecordedRow& old, const RecordedRow& current) {
    return {current.mraysPerSecond / old.mraysPerSecond, current.low / old.high, current.high / old.low};
}

Ratio over(const Ratio& a, const Ratio& b) { return {a.value / b.value, a.low / b.high, a.high / b.low}; }

Change changeOf(const Ratio& ratio) {
    return ratio.high < 1.0 ? Change::slower : ratio.low > 1.0 ? Change::faster : Change::none;
}

const RecordedRow* findRow(std::span<const RecordedRow> rows, const RecordedRow& like) {
    const auto found = std::ranges::find_if(rows, [&](const RecordedRow& row) { return row.sameSubject(like); });
    return found != rows.end() ? &*found : nullptr;
}

std::optional<Ratio> driftOf(std::span<const RecordedRow> old, std::span<const RecordedRow> current,
                             const RecordedRow& row) {
    const RecordedRow peer{.scene = row.scene, .rayKind = row.rayKind, .tracer = kDriftPeer};
    const RecordedRow* const before = findRow(old, peer);
    const RecordedRow* const now = findRow(current, peer);
    if (before == nullptr || now == nullptr) return std::nullopt;
    return ratioOf(*before, *now);
}

}  // namespace

bool RecordedRow::sameSubject(const RecordedRow& other) const {
    return scene == other.scene && rayKind == other.rayKind && tracer == other.tracer && layout == other.layout &&
           triangle == other.triangle && builder == other.builder && variation == other.variation;
}

std::vector<RowComparison> compareRows(std::span<const RecordedRow> old, std::span<const RecordedRow> current) {
    std::vector<RowComparison> comparisons;
    for (const RecordedRow& row : current) {
        const RecordedRow* const before = findRow(old, row);
        if (before == nullptr) continue;
        RowComparison comparison{row, ratioOf(*before, row)};
        if (const std::optional<Ratio> drift = driftOf(old, current, row))
            comparison.normalised = over(comparison.ratio, *drift);
        const Change raw = changeOf(comparison.ratio);
        const Change fair = comparison.normalised ? changeOf(*comparison.normalised) : raw;
        if (raw == fair && !row.tracer.starts_with("embree")) comparison.change = raw;
        comparisons.push_back(comparison);
    }
    return comparisons;
}

}  // namespace raylab
