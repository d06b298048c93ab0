#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "engine/accel/aabb.h"

namespace raylab {

/// Stands for the vertices of a primitive that is no triangle: its box is all there is to know of it.
constexpr glm::uvec3 kBoxAlone(0xffffffffu);

/// What a tree is built over. Whoever builds keeps the memory until the builder returns.
struct BuildInput {
    std::span<const Aabb> bounds;  ///< of the primitives; those not usable() are left out and counted
    std::span<const glm::vec3> positions;
    /// One for each of `bounds` (kBoxAlone: a primitive of another kind), or none where no primitive is a triangle.
    std::span<const glm::uvec3> triangles;
};

/// How the caller follows and stops a build.
struct BuildControl {
    /// The part that is done, 0 .. 1; may be empty. Called some sixty times from any thread, a little out of order.
    std::function<void(float)> progress;
    const std::atomic<bool>* cancel = nullptr;  ///< once true, the work ends by throwing Cancelled
};

/// Thrown by work that BuildControl::cancel ended; no result is left behind, and arguments are as they were.
class Cancelled : public std::exception {
public:
    const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace raylab
