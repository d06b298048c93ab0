#pragma once

#include <string>

namespace raylab {

/// printf of up to four numbers, of at most 191 characters.
std::string svgText(const char* format, double a, double b = 0.0, double c = 0.0, double d = 0.0);

}  // namespace raylab
