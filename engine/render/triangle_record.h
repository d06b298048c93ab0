#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shaders/shared/scene.h"

namespace raylab {

/// A ray-triangle test of the software traversal, and what a triangle stores for it.
struct TriangleTestInfo {
    std::string_view name;
    std::string_view help;
    uint32_t words;  ///< uvec4s of a triangle
};

/// In the order of kTriangle... in shaders/shared/scene.h.
std::span<const TriangleTestInfo> triangleTests();
std::vector<std::string> triangleTestNames();
/// Its kTriangle.... Throws Error where there is none of that name.
uint32_t findTriangleTest(std::string_view name);

/// The words of a triangle for test `test`, of which the first TriangleTestInfo::words count: three or four vectors (see
/// shaders/trace/triangle.glsl), and in the last components the instance, the primitive and the opacity. A slot
/// that names a quadric is the same for every test.
std::array<glm::uvec4, 4> packTriangle(uint32_t test, const shared::TraceTriangle& triangle);

}  // namespace raylab
