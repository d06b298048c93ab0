#pragma once

#include "engine/measure/stability/ray_sets.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// Rays for tests of traversals, and the scenes that they are for.
namespace raylab::support {

using stability::ball;
using stability::bumpyBall;
using stability::gridOfCubes;
using stability::instancedSoup;
using stability::makeSolid;
using stability::randomRays;
using stability::raysAlongAxes;
using stability::raysAtEdges;
using stability::raysFromInside;
using stability::sceneOf;
using stability::soupScene;

}  // namespace raylab::support
