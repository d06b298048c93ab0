#include "engine/accel/build_auto.h"

#include "engine/accel/build_binned.h"
#include "engine/accel/build_spatial.h"
#include "engine/accel/quality.h"

namespace raylab {
namespace {

/// What the first build takes of both.
constexpr float kBinnedShare = 0.25f;

BuildControl partOf(const BuildControl& control, float from, float to) {
    BuildControl part = control;
    if (control.progress)
        part.progress = [&control, from, to](float done) { control.progress(from + (to - from) * done); };
    return part;
}

}  // namespace

Bvh buildAuto(const BuildInput& input, const BvhConfig& config, const BuildControl& control) {
    Bvh binned = buildBinned(input.bounds, config, partOf(control, 0.0f, kBinnedShare));
    if (input.triangles.empty() || measureQuality(binned, config).siblingOverlap <= kOverlapWorthSplits) return binned;
    binned = {};
    return buildSpatial(input, config, partOf(control, kBinnedShare, 1.0f));
}

}  // namespace raylab
