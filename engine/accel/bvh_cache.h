#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/accel/bvh.h"

namespace raylab {

struct Hash128 {
    uint64_t low = 0;
    uint64_t high = 0;

    bool operator==(const Hash128&) const = default;
};

/// MurmurHash3_x64_128 (Appleby 2011, public domain), whose two equal seeds are one of 128 bits here, so that hashes of
/// several spans can be chained. Spreads well and fast (some 4 GB/s); not proof against an adversary.
Hash128 hashBytes(std::span<const std::byte> bytes, Hash128 seed = {});

/// What a tree is found again by: whatever its builder got to see.
struct BvhCacheKey {
    Hash128 content;
    uint32_t primitiveCount = 0;  ///< ids in Bvh::order are below
};

/// `bounds`: of all primitives. `positions` and `triangles` matter to builders that split triangles, and are empty for
/// others. Everything in `config` counts.
BvhCacheKey bvhCacheKey(std::string_view builder, const BvhConfig& config, std::span<const Aabb> bounds,
                        std::span<const glm::vec3> positions = {}, std::span<const glm::uvec3> triangles = {});

/// A folder of trees, one file each. May be used by several threads and processes at once.
struct BvhCache {
    std::filesystem::path folder;  ///< created when first written to; empty: nothing is loaded or stored
    uint64_t maxBytes = uint64_t{2} << 30;  ///< of all files together; those not used for longest go first

    mutable std::atomic<uint32_t> hits{0};
    mutable std::atomic<uint32_t> misses{0};    ///< no such file
    mutable std::atomic<uint32_t> rejected{0};  ///< files that were torn, damaged, of another version or unreadable
    mutable std::atomic<uint32_t> stored{0};
    mutable std::atomic<bool> writable{true};  ///< false after the first failure to write, which is warned of
};

/// $XDG_CACHE_HOME/raylab/bvh, or ~/.cache/raylab/bvh; empty where the environment names neither.
std::filesystem::path bvhCacheFolder();

/// The file of a key.
std::filesystem::path bvhCacheFile(const BvhCache& cache, const BvhCacheKey& key);

/// The tree that was stored under `key`, or nothing. A file counts only if it is whole, its checksum is right, and the
/// tree in it is one: children after their parents, each node with one, leaves and ids within their arrays, no deeper
/// than kMaxBvhDepth. Never throws for what is on the disk.
std::optional<Bvh> loadCachedBvh(const BvhCache& cache, const BvhCacheKey& key);

/// Writes to a name of its own, then renames: a reader sees all or nothing. Removes the files not used for longest
/// where the folder would exceed maxBytes; a tree larger than that is not stored. What the disk refuses (full,
/// read-only) is warned of once, and ends writing; it never throws.
void storeCachedBvh(const BvhCache& cache, const BvhCacheKey& key, const Bvh& bvh);

}  // namespace raylab
