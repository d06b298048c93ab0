#include "engine/accel/bvh_cache.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace raylab {
namespace {

constexpr CacheFormat kFormat{{'r', 'a', 'y', 'l', 'a', 'b', 'v', 'h'}, 2, ".bvh", "trees"};

/// Part of every key: a change of what a builder makes of the same input takes a new one.
constexpr uint32_t kKeyVersion = 1;

static_assert(std::is_trivially_copyable_v<BvhNode>);

/// Followed by the nodes and the order.
struct TreeHeader {
    uint64_t nodes = 0;
    uint64_t slots = 0;
    uint64_t skipped = 0;
    uint32_t depth = 0;
    uint32_t nodeBytes = sizeof(BvhNode);
};

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
void takeItems(std::span<const std::byte>& bytes, std::vector<Item>& items, uint64_t count) {
    items.resize(count);
    const std::span<const std::byte> taken = bytes.first(count * sizeof(Item));
    std::ranges::copy(taken, std::as_writable_bytes(std::span(items)).begin());
    bytes = bytes.subspan(taken.size());
}

std::optional<Bvh> treeIn(std::span<const std::byte> bytes) {
    TreeHeader header;
    if (bytes.size() < sizeof(header)) return std::nullopt;
    std::memcpy(&header, bytes.data(), sizeof(header));
    bytes = bytes.subspan(sizeof(header));
    if (header.nodeBytes != sizeof(BvhNode) || header.nodes > bytes.size() || header.slots > bytes.size() ||
        header.nodes * sizeof(BvhNode) + header.slots * sizeof(uint32_t) != bytes.size())
        return std::nullopt;
    Bvh bvh;
    bvh.depth = header.depth;
    bvh.skipped = header.skipped;
    takeItems(bytes, bvh.nodes, header.nodes);
    takeItems(bytes, bvh.order, header.slots);
    return bvh;
}

template <class Item>
void addItems(std::vector<std::byte>& bytes, std::span<const Item> items) {
    const std::span<const std::byte> more = std::as_bytes(items);
    bytes.insert(bytes.end(), more.begin(), more.end());
}

}  // namespace

BvhCacheKey bvhCacheKey(std::string_view builder, const BvhConfig& config, std::span<const Aabb> bounds,
                        std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles) {
    BvhCacheKey key;
    key.primitiveCount = static_cast<uint32_t>(bounds.size());
    key.content = hashItems(std::span<const uint32_t>(&kKeyVersion, 1));
    key.content = hashItems(std::span<const char>(builder), key.content);
    // As bytes, so that a field that is added counts without a change here; padding could only cause a miss.
    key.content = hashItems(std::span<const BvhConfig>(&config, 1), key.content);
    key.content = hashItems(bounds, key.content);
    key.content = hashItems(positions, key.content);
    key.content = hashItems(triangles, key.content);
    return key;
}

std::filesystem::path bvhCacheFolder() { return cacheFolder("bvh"); }

std::filesystem::path bvhCacheFile(const BvhCache& cache, const BvhCacheKey& key) {
    return cacheFile(cache, kFormat, key.content);
}

std::optional<Bvh> loadCachedBvh(const BvhCache& cache, const BvhCacheKey& key) {
    std::optional<Bvh> bvh;
    const bool found = loadCached(cache, kFormat, key.content, [&](std::span<const std::byte> bytes) {
        bvh = treeIn(bytes);
        return bvh && isTree(*bvh, key.primitiveCount);
    });
    return found ? bvh : std::nullopt;
}

void storeCachedBvh(const BvhCache& cache, const BvhCacheKey& key, const Bvh& bvh) {
    const TreeHeader header{bvh.nodes.size(), bvh.order.size(), bvh.skipped, bvh.depth};
    std::vector<std::byte> bytes;
    bytes.reserve(sizeof(header) + bvh.nodes.size() * sizeof(BvhNode) + bvh.order.size() * sizeof(uint32_t));
    addItems(bytes, std::span<const TreeHeader>(&header, 1));
    addItems(bytes, std::span<const BvhNode>(bvh.nodes));
    addItems(bytes, std::span<const uint32_t>(bvh.order));
    storeCached(cache, kFormat, key.content, bytes);
}

}  // namespace raylab
