#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace raylab {

/// A row of a benchmark as its JSON keeps it.
struct RecordedRow {
    std::string scene;
    std::string rayKind;
    std::string tracer;
    std::string layout;
    std::string triangle;
    std::string builder;
    std::string variation;
    double mraysPerSecond = 0.0;
    double low = 0.0;
    double high = 0.0;

    bool sameSubject(const RecordedRow& other) const;
};

/// new / old with an interval from the two runs' intervals: its low end is the new low over the old high.
struct Ratio {
    double value = 1.0;
    double low = 1.0;
    double high = 1.0;
};

enum class Change { none, faster, slower };

struct RowComparison {
    RecordedRow row;  ///< of the new run
    Ratio ratio;
    /// Over the ratio of the peer on the same rays: without what the machine's clock and load changed between the runs.
    /// Nothing where a run has no such peer.
    std::optional<Ratio> normalised;
    /// Not `none` only where the intervals of old and new do not overlap, and still do not after normalisation.
    /// Always `none` for Embree, whose speed is not ours.
    Change change = Change::none;
};

/// The peer that tells how fast the machine was.
constexpr const char* kDriftPeer = "embree1";

/// One for each row of `current` that `old` has too, in the order of `current`.
std::vector<RowComparison> compareRows(std::span<const RecordedRow> old, std::span<const RecordedRow> current);

}  // namespace raylab
