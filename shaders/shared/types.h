// The one file that knows which language reads it: the shared headers below are C++ and GLSL at once.
#ifndef RAYLAB_SHARED_TYPES_H
#define RAYLAB_SHARED_TYPES_H

#ifdef __cplusplus
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#define RAYLAB_SHARED_BEGIN namespace raylab::shared {
#define RAYLAB_SHARED_END }
#define RAYLAB_CONST constexpr
#define RAYLAB_FN inline
#define RAYLAB_CHECK(type, size) static_assert(sizeof(type) == (size) && alignof(type) == 4, #type)

namespace raylab::shared {
using glm::clamp;
using glm::dot;
using glm::max;
using glm::min;
using glm::mix;
using glm::uvec4;
using glm::vec3;
using glm::vec4;
using uint = uint32_t;
}  // namespace raylab::shared
#else
#define RAYLAB_SHARED_BEGIN
#define RAYLAB_SHARED_END
#define RAYLAB_CONST const
#define RAYLAB_FN
#define RAYLAB_CHECK(type, size)
#endif

#endif
