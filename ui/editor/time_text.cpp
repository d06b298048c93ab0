#include "ui/editor/time_text.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace raylab {

std::string timeText(double seconds) {
    std::array<char, 32> text{};
    if (seconds < 9.95) {
        std::snprintf(text.data(), text.size(), "%.1f s", seconds);
        return text.data();
    }
    constexpr double kLongest = 1e12;
    const auto whole = static_cast<int64_t>(std::lround(std::fmin(seconds, kLongest)));
    const auto two = [&](int64_t unit, const char* large, int64_t part, const char* small) {
        std::string result = std::to_string(whole / unit) + " " + large;
        if (const int64_t rest = whole % unit / part; rest > 0) result += " " + std::to_string(rest) + " " + small;
        return result;
    };
    if (whole < 60) return std::to_string(whole) + " s";
    if (whole < 3600) return two(60, "min", 1, "s");
    if (whole < 86400) return two(3600, "h", 60, "min");
    return two(86400, "d", 3600, "h");
}

}  // namespace raylab
