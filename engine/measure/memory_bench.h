#pragma once

#include <cstddef>
#include <cstdint>

namespace raylab {

struct MemoryBenchConfig {
    size_t copyBytes = size_t{256} << 20;
    size_t largeBytes = size_t{64} << 20;  ///< of a table that caches do not hold; rounded down to a power of two
    size_t smallBytes = size_t{1} << 20;   ///< of one that they do; rounded down to a power of two
    size_t loads = size_t{1} << 22;        ///< of 16 bytes, from each table
    int repeats = 3;                       ///< after one that is not counted; the fastest counts
};

/// What the host's memory gives to all threads together, bytes a second.
struct MemoryBandwidth {
    double copy = 0.0;         ///< of memcpy: each byte counts once, though it is read and written
    double gatherLarge = 0.0;  ///< of independent random loads of 16 bytes, as a traversal fetches
    double gatherSmall = 0.0;
};

/// Takes about half a second.
MemoryBandwidth measureHostMemory(const MemoryBenchConfig& config = {});

}  // namespace raylab
