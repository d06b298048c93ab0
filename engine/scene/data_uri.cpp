#include "engine/scene/data_uri.h"

#include <array>
#include <cstdint>

#include "engine/core/error.h"

namespace raylab {
namespace {

constexpr std::array<int8_t, 256> kBase64Digits = [] {
    std::array<int8_t, 256> digits{};
    digits.fill(-1);
    for (int i = 0; i < 26; ++i) {
        digits[static_cast<size_t>('A' + i)] = static_cast<int8_t>(i);
        digits[static_cast<size_t>('a' + i)] = static_cast<int8_t>(26 + i);
    }
    for (int i = 0; i < 10; ++i) digits[static_cast<size_t>('0' + i)] = static_cast<int8_t>(52 + i);
    digits['+'] = digits['-'] = 62;
    digits['/'] = digits['_'] = 63;
    return digits;
}();

}  // namespace

bool isDataUri(std::string_view uri) { return uri.starts_with("data:"); }

std::vector<std::byte> decodeDataUri(std::string_view uri, const std::string& place) {
    const size_t comma = uri.find(',');
    if (!isDataUri(uri) || comma == std::string_view::npos ||
        uri.substr(0, comma).find(";base64") == std::string_view::npos)
        throw Error(place + ": the data URI is not base64; export the file again");
    std::vector<std::byte> bytes;
    bytes.reserve((uri.size() - comma) / 4 * 3);
    uint32_t pending = 0;
    int bits = 0;
    for (size_t i = comma + 1; i < uri.size() && uri[i] != '='; ++i) {
        const int digit = kBase64Digits[static_cast<unsigned char>(uri[i])];
        if (digit < 0)
            throw Error(place + ": the data URI holds a character that is not base64; export the file again");
        pending = (pending << 6) | static_cast<uint32_t>(digit);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<std::byte>((pending >> bits) & 0xFF));
    }
    return bytes;
}

}  // namespace raylab
