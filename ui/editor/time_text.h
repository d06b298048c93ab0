#pragma once

#include <string>

namespace raylab {

/// A duration for people, by its two largest units: "8 s", "1 min 20 s", "2 h 5 min", "3 d 4 h". Below 10 s with a
/// decimal.
std::string timeText(double seconds);

}  // namespace raylab
