#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace raylab {

bool isDataUri(std::string_view uri);

/// Bytes of a `data:...;base64,...` URI (RFC 2397). Throws Error, naming `place`, where it is not one.
std::vector<std::byte> decodeDataUri(std::string_view uri, const std::string& place);

}  // namespace raylab
