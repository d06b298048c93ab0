#include "ui/editor/free_name.h"

namespace raylab {

std::filesystem::path freeFileName(const std::string& stem, const std::string& extension) {
    for (int i = 1;; ++i) {
        std::filesystem::path path = stem + "-" + std::to_string(i) + extension;
        if (!std::filesystem::exists(path)) return path;
    }
}

}  // namespace raylab
