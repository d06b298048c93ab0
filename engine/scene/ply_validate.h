#pragma once

#include <filesystem>

namespace raylab {

/// Throws Error, naming the line where it can, unless the file is PLY 1.0 (Turk 1994, "The PLY Polygon File Format")
/// from its first line to its last element: known types, and as many numbers as the header promises. Assimp 5.2.5 hangs
/// or crashes on a header or an element that is cut short.
void validatePly(const std::filesystem::path& path);

}  // namespace raylab
