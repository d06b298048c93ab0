#pragma once

#include <cstdlib>
#include <string>

namespace raylab::support {

/// How often a fuzz test repeats its rounds: 1, or what the environment variable RAYLAB_FUZZ says, for long runs. Every
/// round has a seed of its own, which the messages of a failure name.
inline unsigned fuzzRepeats() {
    const char* text = std::getenv("RAYLAB_FUZZ");
    return text != nullptr ? static_cast<unsigned>(std::stoul(text)) : 1u;
}

}  // namespace raylab::support
