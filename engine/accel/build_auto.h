#pragma once

#include "engine/accel/build_input.h"
#include "engine/accel/bvh.h"

namespace raylab {

/// buildBinned(), and buildSpatial() in its stead where the siblings of that tree overlap by more than
/// kOverlapWorthSplits (BvhQuality::siblingOverlap): large triangles beside small ones, as in rooms and buildings. A
/// spatial build takes some three times as long and gains nothing where boxes hardly overlap, as on scanned surfaces.
/// The same tree for any number of threads; throws as both do.
Bvh buildAuto(const BuildInput& input, const BvhConfig& config = {}, const BuildControl& control = {});

/// Between .16 (dragon) and .25 (the scene lights) of the scenes whose builders were compared.
constexpr double kOverlapWorthSplits = 0.2;

}  // namespace raylab
