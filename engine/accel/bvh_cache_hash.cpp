#include <bit>
#include <cstring>
#include <type_traits>

#include "engine/accel/bvh_cache.h"

namespace raylab {
namespace {

constexpr uint64_t kFactor1 = 0x87c37b91114253d5u;
constexpr uint64_t kFactor2 = 0x4cf5ad432745937fu;

/// Part of every key: a change of BvhNode, of the file or of what a builder makes of the same input takes a new one.
constexpr uint32_t kKeyVersion = 1;

uint64_t scramble1(uint64_t word) { return std::rotl(word * kFactor1, 31) * kFactor2; }
uint64_t scramble2(uint64_t word) { return std::rotl(word * kFactor2, 33) * kFactor1; }

uint64_t finalMix(uint64_t word) {
    word = (word ^ (word >> 33)) * 0xff51afd7ed558ccdu;
    word = (word ^ (word >> 33)) * 0xc4ceb9fe1a85ec53u;
    return word ^ (word >> 33);
}

template <class Item>
Hash128 hashItems(std::span<const Item> items, Hash128 seed) {
    static_assert(std::is_trivially_copyable_v<Item>);
    return hashBytes(std::as_bytes(items), seed);
}

}  // namespace

Hash128 hashBytes(std::span<const std::byte> bytes, Hash128 seed) {
    Hash128 hash = seed;
    const size_t whole = bytes.size() / 16 * 16;
    for (size_t i = 0; i < whole; i += 16) {
        uint64_t words[2];
        std::memcpy(words, bytes.data() + i, 16);
        hash.low = (std::rotl(hash.low ^ scramble1(words[0]), 27) + hash.high) * 5 + 0x52dce729;
        hash.high = (std::rotl(hash.high ^ scramble2(words[1]), 31) + hash.low) * 5 + 0x38495ab5;
    }
    if (whole < bytes.size()) {
        uint64_t words[2] = {0, 0};
        std::memcpy(words, bytes.data() + whole, bytes.size() - whole);
        hash.low ^= scramble1(words[0]);
        hash.high ^= scramble2(words[1]);
    }
    hash.low ^= bytes.size();
    hash.high ^= bytes.size();
    hash.low += hash.high;
    hash.high += hash.low;
    hash.low = finalMix(hash.low);
    hash.high = finalMix(hash.high);
    hash.low += hash.high;
    hash.high += hash.low;
    return hash;
}

BvhCacheKey bvhCacheKey(std::string_view builder, const BvhConfig& config, std::span<const Aabb> bounds,
                        std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles) {
    BvhCacheKey key;
    key.primitiveCount = static_cast<uint32_t>(bounds.size());
    key.content = hashItems(std::span<const uint32_t>(&kKeyVersion, 1), {});
    key.content = hashItems(std::span<const char>(builder), key.content);
    // As bytes, so that a field that is added counts without a change here; padding could only cause a miss.
    key.content = hashItems(std::span<const BvhConfig>(&config, 1), key.content);
    key.content = hashItems(bounds, key.content);
    key.content = hashItems(positions, key.content);
    key.content = hashItems(triangles, key.content);
    return key;
}

}  // namespace raylab
