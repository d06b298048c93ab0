#pragma once

#include <filesystem>
#include <string>

namespace raylab {

/// The first of STEM-1.EXTENSION, STEM-2, ... that is free in the current folder.
std::filesystem::path freeFileName(const std::string& stem, const std::string& extension);

}  // namespace raylab
