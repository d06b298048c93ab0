#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace raylab {

/// The whole file. Throws Error where it does not exist, is a folder or cannot be read.
std::vector<std::byte> readFile(const std::filesystem::path& path);

/// Throws Error, naming the path and what to do, unless it is a readable regular file.
void requireReadableFile(const std::filesystem::path& path);

/// Throws Error unless a file can be created at `path`: called before hours of work, not after. Creates missing parent folders.
void requireWritable(const std::filesystem::path& path);

/// Writes to a temporary name beside `path` and renames it, so that a file is either whole or as it was before.
/// What is no file, a device or a pipe, is written as it is. Throws Error (full disk, read-only folder); leaves no
/// temporary behind.
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// As above, for writers that need a path themselves: `write` gets the temporary name.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path& temporary)>& write);

/// Folder of the running executable.
std::filesystem::path executableFolder();

/// A data folder ("shaders", "assets") beside the executable or in ../share/raylab of an installed prefix.
/// Throws Error where neither exists.
std::filesystem::path dataFolder(const std::string& name);

}  // namespace raylab
