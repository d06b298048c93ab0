#pragma once

#include <filesystem>
#include <string>

namespace raylab {

/// Runs gnuplot on a script, in the script's folder. False where it is not installed. Throws Error where it fails.
bool runGnuplot(const std::filesystem::path& script);

/// A text in single quotes, as gnuplot reads it.
std::string gnuplotQuoted(const std::string& text);

}  // namespace raylab
