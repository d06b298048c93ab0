#include "engine/core/hash.h"

#include <bit>
#include <cstring>

namespace raylab {
namespace {

constexpr uint64_t kFactor1 = 0x87c37b91114253d5u;
constexpr uint64_t kFactor2 = 0x4cf5ad432745937fu;

uint64_t scramble1(uint64_t word) { return std::rotl(word * kFactor1, 31) * kFactor2; }
uint64_t scramble2(uint64_t word) { return std::rotl(word * kFactor2, 33) * kFactor1; }

uint64_t finalMix(uint64_t word) {
    word = (word ^ (word >> 33)) * 0xff51afd7ed558ccdu;
    word = (word ^ (word >> 33)) * 0xc4ceb9fe1a85ec53u;
    return word ^ (word >> 33);
}

std::string hexadecimal(uint64_t value) {
    std::string text(16, '0');
    for (size_t i = text.size(); i-- > 0; value >>= 4) text[i] = "0123456789abcdef"[value & 15u];
    return text;
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

std::string hashText(const Hash128& hash) { return hexadecimal(hash.high) + hexadecimal(hash.low); }

}  // namespace raylab
