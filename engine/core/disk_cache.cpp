#include "engine/core/disk_cache.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <system_error>
#include <vector>

#include "engine/core/log.h"

namespace raylab {
namespace {
namespace fs = std::filesystem;

constexpr const char* kTemporaryExtension = ".tmp";
constexpr auto kStaleTemporary = std::chrono::hours(1);  // older: a writer that died left it

/// Followed by the contents. Without padding, as its bytes are hashed.
struct Header {
    std::array<char, 8> magic{};
    uint32_t version = 0;
    uint32_t unused = 0;
    Hash128 key;
    uint64_t bytes = 0;  ///< that follow
    Hash128 checksum;    ///< of everything else, this being zero
};
static_assert(sizeof(Header) == 56);

Hash128 checksumOf(Header header, std::span<const std::byte> bytes) {
    header.checksum = {};
    return hashBytes(bytes, hashItems(std::span<const Header>(&header, 1)));
}

Header headerFor(const CacheFormat& format, const Hash128& key, std::span<const std::byte> bytes) {
    Header header;
    header.magic = format.magic;
    header.version = format.version;
    header.key = key;
    header.bytes = bytes.size();
    header.checksum = checksumOf(header, bytes);
    return header;
}

/// Whether the header is one that this program wrote for this key, and its file as long as it says.
bool isOurs(const Header& header, const CacheFormat& format, const Hash128& key, uint64_t fileBytes) {
    return header.magic == format.magic && header.version == format.version && header.key == key &&
           fileBytes >= sizeof(Header) && header.bytes == fileBytes - sizeof(Header);
}

/// What is in a file, or nothing.
std::optional<std::vector<std::byte>> readWhole(const fs::path& path, const CacheFormat& format, const Hash128& key) {
    std::error_code code;
    const uint64_t fileBytes = fs::file_size(path, code);
    std::ifstream stream(path, std::ios::binary);
    Header header;
    stream.read(reinterpret_cast<char*>(&header), sizeof(Header));
    if (code || !stream || !isOurs(header, format, key, fileBytes)) return std::nullopt;
    std::vector<std::byte> bytes(header.bytes);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!stream || !(checksumOf(header, bytes) == header.checksum)) return std::nullopt;
    return bytes;
}

/// What the disk had against it, or nothing.
std::error_code writeWhole(const fs::path& path, const Header& header, std::span<const std::byte> bytes) {
    errno = 0;
    std::ofstream stream(path, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(&header), sizeof(Header));
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (stream) return {};
    return errno != 0 ? std::error_code(errno, std::generic_category()) : std::make_error_code(std::errc::io_error);
}

struct CachedFile {
    fs::path path;
    fs::file_time_type used;
    uint64_t bytes;
};

/// All files of the cache. Removes what writers that died have left. Files that vanish meanwhile are left out.
std::vector<CachedFile> listFiles(const fs::path& folder, const CacheFormat& format) {
    std::vector<CachedFile> files;
    std::error_code code;
    for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
        std::error_code gone;
        const fs::path& path = entry->path();
        const CachedFile file{path, fs::last_write_time(path, gone), entry->file_size(gone)};
        if (gone) continue;
        if (path.extension() == format.extension) files.push_back(file);
        if (path.extension() == kTemporaryExtension && fs::file_time_type::clock::now() - file.used > kStaleTemporary)
            fs::remove(path, gone);
    }
    return files;
}

/// Removes the files that were not used for longest until `bytes` more fit. One that another process removed first is
/// as good as removed.
void makeRoom(const DiskCache& cache, const CacheFormat& format, uint64_t bytes) {
    std::vector<CachedFile> files = listFiles(cache.folder, format);
    std::sort(files.begin(), files.end(), [](const CachedFile& a, const CachedFile& b) { return a.used < b.used; });
    uint64_t total = bytes;
    for (const CachedFile& file : files) total += file.bytes;
    for (const CachedFile& file : files) {
        if (total <= cache.maxBytes) return;
        std::error_code gone;
        fs::remove(file.path, gone);
        total -= file.bytes;
    }
}

/// Beside `path`, and of no other thread or process.
fs::path temporaryName(const fs::path& path) {
    static std::atomic<uint32_t> next{0};
    return path.string() + "." + std::to_string(::getpid()) + "." + std::to_string(next++) + kTemporaryExtension;
}

void stopWriting(const DiskCache& cache, const CacheFormat& format, const std::string& reason) {
    if (cache.writable.exchange(false))
        logWarning(std::string(format.contents) + " are not cached in " + cache.folder.string() + ": " + reason);
}

}  // namespace

fs::path cacheFolder(const std::string& name) {
    const char* const cacheHome = std::getenv("XDG_CACHE_HOME");
    // The XDG base directory specification: a path that is not absolute is to be ignored.
    if (cacheHome != nullptr && fs::path(cacheHome).is_absolute()) return fs::path(cacheHome) / "raylab" / name;
    const char* const home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') return fs::path(home) / ".cache" / "raylab" / name;
    return {};
}

fs::path cacheFile(const DiskCache& cache, const CacheFormat& format, const Hash128& key) {
    return cache.folder / (hashText(key) + format.extension);
}

bool loadCached(const DiskCache& cache, const CacheFormat& format, const Hash128& key,
                const std::function<bool(std::span<const std::byte>)>& accept) {
    if (cache.folder.empty()) return false;
    const fs::path path = cacheFile(cache, format, key);
    std::error_code code;
    if (!fs::exists(path, code)) {
        ++cache.misses;
        return false;
    }
    const std::optional<std::vector<std::byte>> bytes = readWhole(path, format, key);
    const bool accepted = bytes && accept(*bytes);
    ++(accepted ? cache.hits : cache.rejected);
    // Marks it as used; where the folder is read-only nothing is removed either.
    if (accepted) fs::last_write_time(path, fs::file_time_type::clock::now(), code);
    return accepted;
}

void storeCached(const DiskCache& cache, const CacheFormat& format, const Hash128& key,
                 std::span<const std::byte> bytes) {
    const uint64_t fileBytes = sizeof(Header) + bytes.size();
    if (cache.folder.empty() || !cache.writable || fileBytes > cache.maxBytes) return;
    std::error_code code;
    fs::create_directories(cache.folder, code);
    if (code) return stopWriting(cache, format, code.message());
    makeRoom(cache, format, fileBytes);
    const fs::path path = cacheFile(cache, format, key);
    const fs::path temporary = temporaryName(path);
    code = writeWhole(temporary, headerFor(format, key, bytes), bytes);
    if (!code) fs::rename(temporary, path, code);
    if (!code) {
        ++cache.stored;
        return;
    }
    stopWriting(cache, format,
                "a file cannot be written (" + code.message() + "); is the disk full or the folder read-only?");
    std::error_code gone;
    fs::remove(temporary, gone);
}

}  // namespace raylab
