#pragma once

#include <cstddef>
#include <span>

#include "engine/scene/scene.h"

namespace raylab {

/// A closed cave of about `triangles` triangles around the origin, some 2 across, with a camera in it: a sphere from a
/// subdivided cube, displaced by waves of six octaves. The shape is the same for every number; more triangles follow it
/// closer. Every ray within hits, so that the cost of a ray depends on the tree and not on how much of the sky it sees.
Scene makeCave(size_t triangles);

/// Least squares of y over log2(x).
struct LogarithmicFit {
    double constant = 0.0;
    double perDoubling = 0.0;
    double rSquared = 0.0;  ///< the part of y's variance that the fit explains; 1 where y does not vary
};

/// `x` positive, of two different values at least; `y` as long.
LogarithmicFit fitLogarithm(std::span<const double> x, std::span<const double> y);

}  // namespace raylab
