#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "engine/accel/bvh.h"
#include "engine/core/disk_cache.h"

namespace raylab {

/// What a tree is found again by: whatever its builder got to see.
struct BvhCacheKey {
    Hash128 content;
    uint32_t primitiveCount = 0;  ///< ids in Bvh::order are below
};

/// `bounds`: of all primitives. `positions` and `triangles` matter to builders that split triangles, and are empty for
/// others. Everything in `config` counts.
BvhCacheKey bvhCacheKey(std::string_view builder, const BvhConfig& config, std::span<const Aabb> bounds,
                        std::span<const glm::vec3> positions = {}, std::span<const glm::uvec3> triangles = {});

/// A folder of trees.
using BvhCache = DiskCache;

/// $XDG_CACHE_HOME/raylab/bvh, as cacheFolder() has it.
std::filesystem::path bvhCacheFolder();

/// The file of a key.
std::filesystem::path bvhCacheFile(const BvhCache& cache, const BvhCacheKey& key);

/// The tree that was stored under `key`, or nothing. A file counts only if it is whole, its checksum is right, and the
/// tree in it is one: children after their parents, each node with one, leaves and ids within their arrays, no deeper
/// than kMaxBvhDepth. Never throws for what is on the disk.
std::optional<Bvh> loadCachedBvh(const BvhCache& cache, const BvhCacheKey& key);

/// As storeCached().
void storeCachedBvh(const BvhCache& cache, const BvhCacheKey& key, const Bvh& bvh);

}  // namespace raylab
