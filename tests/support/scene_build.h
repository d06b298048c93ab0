#pragma once

#include "engine/measure/stability/scene_parts.h"
#include "tests/unit/accel_support.h"

/// Scenes built in code.
namespace raylab::support {

using stability::addInstance;
using stability::addMaterial;
using stability::addMesh;
using stability::box;
using stability::ceilingQuad;
using stability::constantEnvironment;
using stability::environmentOf;
using stability::floorQuad;
using stability::glass;
using stability::kPi;
using stability::lambert;
using stability::lamp;
using stability::lookAt;
using stability::lookAtPoint;
using stability::lookDown;
using stability::meshOf;
using stability::quad;

/// Quadrics of each kind, cut by their planes, moved, turned, mirrored and sheared: 40 instances of five meshes of
/// several quadrics each, among a few triangles.
Scene quadricScene(uint32_t seed);

}  // namespace raylab::support
