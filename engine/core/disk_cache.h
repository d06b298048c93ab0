#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "engine/core/hash.h"

namespace raylab {

/// What a cache's files hold. A change of what is in them takes a new version.
struct CacheFormat {
    std::array<char, 8> magic;
    uint32_t version;
    const char* extension;  ///< with its dot
    const char* contents;   ///< in the plural, for warnings
};

/// A folder of results, a file each, found again by a hash of what they were made from. May be used by several threads
/// and processes at once.
struct DiskCache {
    std::filesystem::path folder;           ///< created when first written to; empty: nothing is loaded or stored
    uint64_t maxBytes = uint64_t{2} << 30;  ///< of all files together; those not used for longest go first

    mutable std::atomic<uint32_t> hits{0};
    mutable std::atomic<uint32_t> misses{0};    ///< no such file
    mutable std::atomic<uint32_t> rejected{0};  ///< files that were torn, damaged, of another version or unreadable
    mutable std::atomic<uint32_t> stored{0};
    mutable std::atomic<bool> writable{true};  ///< false after the first failure to write, which is warned of
};

/// $XDG_CACHE_HOME/raylab/NAME, or ~/.cache/raylab/NAME; empty where the environment names neither.
std::filesystem::path cacheFolder(const std::string& name);

/// The file of a key.
std::filesystem::path cacheFile(const DiskCache& cache, const CacheFormat& format, const Hash128& key);

/// Gives `accept` what was stored under `key`, once it is known to be whole by its checksum. False where there is no
/// such file or `accept` refuses it. Never throws for what is on the disk.
bool loadCached(const DiskCache& cache, const CacheFormat& format, const Hash128& key,
                const std::function<bool(std::span<const std::byte>)>& accept);

/// Writes to a name of its own, then renames: a reader sees all or nothing. Removes the
/// files not used for longest where the folder would exceed maxBytes; what is larger than that is not stored. What the
/// disk refuses (full, read-only) is warned of once, and ends writing; it never throws.
void storeCached(const DiskCache& cache, const CacheFormat& format, const Hash128& key,
                 std::span<const std::byte> bytes);

}  // namespace raylab
