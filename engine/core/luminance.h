#pragma once

#include <glm/glm.hpp>

namespace raylab {

/// Of linear RGB with the primaries of Rec. 709, white 1: what 3 consecutive values say (ITU-R BT.709-6, 3.2).
template <typename T>
double luminance(const T* rgb) {
    return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
           0.0722 * static_cast<double>(rgb[2]);
}

inline double luminance(const glm::vec3& rgb) { return luminance(&rgb.x); }

}  // namespace raylab
