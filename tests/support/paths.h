#pragma once

#include <filesystem>

namespace raylab::support {

/// The repository.
std::filesystem::path sourceFolder();
/// The folder of the build that the test belongs to: raylab, shaders/, assets/, tests/.
std::filesystem::path binaryFolder();
/// Scenes that nobody here made; absent where the repository stands alone.
inline std::filesystem::path sharedScenes() { return sourceFolder() / "../shared/scenes"; }

}  // namespace raylab::support
