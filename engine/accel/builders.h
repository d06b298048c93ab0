#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/accel/build_input.h"
#include "engine/accel/bvh.h"

namespace raylab {

/// A builder as the user picks it.
struct BuilderInfo {
    std::string_view name;
    std::string_view help;  ///< one line
};

/// In the order of a list for the user.
std::span<const BuilderInfo> builders();
std::vector<std::string> builderNames();

constexpr std::string_view kDefaultBuilder = "auto";

/// Builds a tree by name, in parallel; the bytes are the same for any number of threads, the depth is never above
/// config.maxDepth, and primitives without a usable() box are left out and counted. Throws Error for a name that is not
/// in builders(), a config out of its ranges or too tight for the primitives, and more primitives than a tree holds;
/// Cancelled where control.cancel turns true, and then leaves nothing behind.
Bvh buildBvh(std::string_view builder, const BuildInput& input, const BvhConfig& config = {},
             const BuildControl& control = {});

}  // namespace raylab
