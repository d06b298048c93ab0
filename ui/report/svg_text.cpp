#include "ui/report/svg_text.h"

#include <array>
#include <cstdio>

namespace raylab {

std::string svgText(const char* format, double a, double b, double c, double d) {
    std::array<char, 192> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, a, b, c, d);
    return buffer.data();
}

}  // namespace raylab
