#include "engine/accel/bvh_cache.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <type_traits>
#include <vector>

#include "engine/core/log.h"

namespace raylab {
namespace {
namespace fs = std::filesystem;

constexpr std::array<char, 8> kMagic = {'r', 'a', 'y', 'l', 'a', 'b', 'v', 'h'};
constexpr uint32_t kFileVersion = 1;
constexpr const char* kExtension = ".bvh";
constexpr const char* kTemporaryExtension = ".tmp";
constexpr auto kStaleTemporary = std::chrono::hours(1);  // older: a writer that died left it

static_assert(std::is_trivially_copyable_v<BvhNode>);

/// Followed by the nodes and the order. Without padding, as its bytes are hashed.
struct Header {
    std::array<char, 8> magic = kMagic;
    uint32_t version = kFileVersion;
    uint32_t nodeBytes = sizeof(BvhNode);
    Hash128 key;
    uint64_t nodes = 0;
    uint64_t slots = 0;
    uint64_t skipped = 0;
    uint32_t depth = 0;
    uint32_t primitives = 0;
    Hash128 checksum;  ///< of everything else, this being zero
};
static_assert(sizeof(Header) == 80);

Header headerFor(const BvhCacheKey& key, const Bvh& bvh) {
    Header header;
    header.key = key.content;
    header.nodes = bvh.nodes.size();
    header.slots = bvh.order.size();
    header.skipped = bvh.skipped;
    header.depth = bvh.depth;
    header.primitives = key.primitiveCount;
    return header;
}

Hash128 checksumOf(Header header, const Bvh& bvh) {
    header.checksum = {};
    Hash128 hash = hashBytes(std::as_bytes(std::span(&header, 1)));
    hash = hashBytes(std::as_bytes(std::span(bvh.nodes)), hash);
    return hashBytes(std::as_bytes(std::span(bvh.order)), hash);
}

uint64_t fileBytes(const Header& header) {
    return sizeof(Header) + header.nodes * sizeof(BvhNode) + header.slots * sizeof(uint32_t);
}

/// Whether the header is one that this program wrote for this key, and as long as it says.
bool isOurs(const Header& header, const BvhCacheKey& key, uint64_t actualBytes) {
    return header.magic == kMagic && header.version == kFileVersion && header.nodeBytes == sizeof(BvhNode) &&
           header.key == key.content && header.primitives == key.primitiveCount && header.nodes <= actualBytes &&
           header.slots <= actualBytes && fileBytes(header) == actualBytes;
}

/// Whether a walk of the tree ends, and stays within its arrays and its stack.
bool isTree(const Bvh& bvh, uint32_t primitiveCount) {
    constexpr uint32_t kNoParent = 0xffffffffu;
    std::vector<uint32_t> depth(bvh.nodes.size(), kNoParent);
    uint32_t deepest = 0;
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        const BvhNode& node = bvh.nodes[i];
        if (i == 0) depth[0] = 0;
        if (depth[i] == kNoParent) return false;
        deepest = std::max(deepest, depth[i]);
        if (node.isLeaf()) {
            if (node.count > uint32_t{kMaxLeafSize} || uint64_t{node.first} + node.count > bvh.order.size())
                return false;
            continue;
        }
        if (node.left <= i || size_t{node.left} + 1 >= bvh.nodes.size()) return false;
        for (const uint32_t child : {node.left, node.left + 1}) {
            if (depth[child] != kNoParent) return false;
            depth[child] = depth[i] + 1;
        }
    }
    return deepest == bvh.depth && deepest <= uint32_t{kMaxBvhDepth} &&
           std::all_of(bvh.order.begin(), bvh.order.end(), [&](uint32_t id) { return id < primitiveCount; });
}

template <class Item>
void readItems(std::istream& stream, std::vector<Item>& items, uint64_t count) {
    items.resize(count);
    stream.read(reinterpret_cast<char*>(items.data()), static_cast<std::streamsize>(count * sizeof(Item)));
}

template <class Item>
void writeItems(std::ostream& stream, std::span<const Item> items) {
    stream.write(reinterpret_cast<const char*>(items.data()), static_cast<std::streamsize>(items.size_bytes()));
}

std::optional<Bvh> readTree(const fs::path& path, const BvhCacheKey& key) {
    std::error_code code;
    const uint64_t actualBytes = fs::file_size(path, code);
    std::ifstream stream(path, std::ios::binary);
    Header header;
    stream.read(reinterpret_cast<char*>(&header), sizeof(Header));
    if (code || !stream || !isOurs(header, key, actualBytes)) return std::nullopt;
    Bvh bvh;
    bvh.depth = header.depth;
    bvh.skipped = header.skipped;
    readItems(stream, bvh.nodes, header.nodes);
    readItems(stream, bvh.order, header.slots);
    if (!stream || checksumOf(header, bvh) != header.checksum || !isTree(bvh, key.primitiveCount)) return std::nullopt;
    return bvh;
}

/// What the disk had against it, or nothing.
std::error_code writeTree(const fs::path& path, const BvhCacheKey& key, const Bvh& bvh) {
    Header header = headerFor(key, bvh);
    header.checksum = checksumOf(header, bvh);
    errno = 0;
    std::ofstream stream(path, std::ios::binary);
    writeItems(stream, std::span<const Header>(&header, 1));
    writeItems(stream, std::span<const BvhNode>(bvh.nodes));
    writeItems(stream, std::span<const uint32_t>(bvh.order));
    stream.close();
    if (stream) return {};
    return errno != 0 ? std::error_code(errno, std::generic_category()) : std::make_error_code(std::errc::io_error);
}

struct CachedFile {
    fs::path path;
    fs::file_time_type used;
    uint64_t bytes;
};

/// All trees in the folder. Removes what writers that died have left. Files that vanish meanwhile are left out.
std::vector<CachedFile> listFiles(const fs::path& folder) {
    std::vector<CachedFile> files;
    std::error_code code;
    for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
        std::error_code gone;
        const fs::path& path = entry->path();
        const CachedFile file{path, fs::last_write_time(path, gone), entry->file_size(gone)};
        if (gone) continue;
        if (path.extension() == kExtension) files.push_back(file);
        if (path.extension() == kTemporaryExtension && fs::file_time_type::clock::now() - file.used > kStaleTemporary)
            fs::remove(path, gone);
    }
    return files;
}

/// Removes the files that were not used for longest until `bytes` more fit. One that another process removed first is
/// as good as removed.
void makeRoom(const BvhCache& cache, uint64_t bytes) {
    std::vector<CachedFile> files = listFiles(cache.folder);
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

void stopWriting(const BvhCache& cache, const std::string& reason) {
    if (cache.writable.exchange(false)) logWarning("trees are not cached in " + cache.folder.string() + ": " + reason);
}

std::string hexadecimal(uint64_t value) {
    std::string text(16, '0');
    for (size_t i = text.size(); i-- > 0; value >>= 4) text[i] = "0123456789abcdef"[value & 15u];
    return text;
}

}  // namespace

fs::path bvhCacheFolder() {
    const char* const cacheHome = std::getenv("XDG_CACHE_HOME");
    // The XDG base directory specification: a path that is not absolute is to be ignored.
    if (cacheHome != nullptr && fs::path(cacheHome).is_absolute()) return fs::path(cacheHome) / "raylab" / "bvh";
    const char* const home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') return fs::path(home) / ".cache" / "raylab" / "bvh";
    return {};
}

fs::path bvhCacheFile(const BvhCache& cache, const BvhCacheKey& key) {
    return cache.folder / (hexadecimal(key.content.high) + hexadecimal(key.content.low) + kExtension);
}

std::optional<Bvh> loadCachedBvh(const BvhCache& cache, const BvhCacheKey& key) {
    if (cache.folder.empty()) return std::nullopt;
    const fs::path path = bvhCacheFile(cache, key);
    std::error_code code;
    if (!fs::exists(path, code)) {
        ++cache.misses;
        return std::nullopt;
    }
    std::optional<Bvh> bvh = readTree(path, key);
    ++(bvh ? cache.hits : cache.rejected);
    // Marks it as used; where the folder is read-only nothing is removed either.
    if (bvh) fs::last_write_time(path, fs::file_time_type::clock::now(), code);
    return bvh;
}

void storeCachedBvh(const BvhCache& cache, const BvhCacheKey& key, const Bvh& bvh) {
    const uint64_t bytes = fileBytes(headerFor(key, bvh));
    if (cache.folder.empty() || !cache.writable || bytes > cache.maxBytes) return;
    std::error_code code;
    fs::create_directories(cache.folder, code);
    if (code) return stopWriting(cache, code.message());
    makeRoom(cache, bytes);
    const fs::path path = bvhCacheFile(cache, key);
    const fs::path temporary = temporaryName(path);
    code = writeTree(temporary, key, bvh);
    if (!code) fs::rename(temporary, path, code);
    if (!code) {
        ++cache.stored;
        return;
    }
    stopWriting(cache, "a file cannot be written (" + code.message() + "); is the disk full or the folder read-only?");
    std::error_code gone;
    fs::remove(temporary, gone);
}

}  // namespace raylab
