#include "tests/support/paths.h"

namespace raylab::support {

std::filesystem::path sourceFolder() { return RAYLAB_SOURCE_DIR; }
std::filesystem::path binaryFolder() { return RAYLAB_BINARY_DIR; }

}  // namespace raylab::support
