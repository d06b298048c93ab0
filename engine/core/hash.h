#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

namespace raylab {

struct Hash128 {
    uint64_t low = 0;
    uint64_t high = 0;

    bool operator==(const Hash128&) const = default;
};

/// MurmurHash3_x64_128 (Appleby 2011, public domain), whose two equal seeds are one of 128 bits here, so that hashes of
/// several spans can be chained. Spreads well and fast (some 4 GB/s); not proof against an adversary.
Hash128 hashBytes(std::span<const std::byte> bytes, Hash128 seed = {});

/// Of the bytes of items; padding among them counts.
template <class Item>
Hash128 hashItems(std::span<const Item> items, Hash128 seed = {}) {
    static_assert(std::is_trivially_copyable_v<Item>);
    return hashBytes(std::as_bytes(items), seed);
}

/// 32 hexadecimal digits.
std::string hashText(const Hash128& hash);

}  // namespace raylab
