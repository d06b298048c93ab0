#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace raylab {

/// Entry i: keep i with probability `threshold`, else take `alias`.
struct AliasEntry {
    float threshold = 1.0f;
    uint32_t alias = 0;
};

/// Walker's alias method (1977) by Vose's linear construction (1991). Weights must be finite and not negative; where all
/// are zero, every entry is equally likely.
std::vector<AliasEntry> buildAliasTable(std::span<const double> weights);

}  // namespace raylab
