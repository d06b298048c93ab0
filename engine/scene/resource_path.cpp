#include "engine/scene/resource_path.h"

#include <algorithm>
#include <charconv>

namespace raylab {
namespace fs = std::filesystem;

namespace {

std::string decodePercent(const std::string& text) {
    std::string decoded;
    for (size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        const char* digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
            decoded += static_cast<char>(value);
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

}  // namespace

fs::path resolveResource(const fs::path& folder, const std::string& uri) {
    std::string slashed = uri;
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    const std::string decoded = decodePercent(slashed);
    const fs::path candidates[] = {folder / decoded, folder / slashed, folder / uri,
                                   folder / fs::path(decoded).filename()};
    for (const fs::path& candidate : candidates) {
        std::error_code code;
        if (fs::is_regular_file(candidate, code)) return candidate;
    }
    return candidates[0];
}

}  // namespace raylab
