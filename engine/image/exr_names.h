#pragma once

#include <string_view>

namespace raylab {

/// Attributes that hold our metadata start so.
constexpr std::string_view kExrMetadataPrefix = "raylab.";

/// Channels that need no layer name: the main image is made of them.
constexpr bool isMainExrChannel(std::string_view name) {
    return name == "R" || name == "G" || name == "B" || name == "A" || name == "Y";
}

}  // namespace raylab
