#include "engine/accel/builders.h"

#include <algorithm>
#include <array>

#include "engine/accel/build_auto.h"
#include "engine/accel/build_binned.h"
#include "engine/accel/build_linear.h"
#include "engine/accel/build_simple.h"
#include "engine/accel/build_spatial.h"
#include "engine/accel/build_sweep.h"
#include "engine/core/error.h"

namespace raylab {
namespace {

using Build = Bvh (*)(const BuildInput&, const BvhConfig&, const BuildControl&);

/// A builder that needs no more than the boxes.
template <auto kBuildBoxes>
Bvh overBoxes(const BuildInput& input, const BvhConfig& config, const BuildControl& control) {
    return kBuildBoxes(input.bounds, config, control);
}

constexpr std::array kBuilders = {
    BuilderInfo{"auto", "binned; spatial for meshes whose boxes overlap much; the default"},
    BuilderInfo{"midpoint", "halves the longest axis of the centroids in space; fast to build, slow to trace"},
    BuilderInfo{"median", "halves the primitives on the longest axis of their centroids; the most even tree"},
    BuilderInfo{"binned", "surface area heuristic over binned centroids"},
    BuilderInfo{"sweep", "surface area heuristic over all centroids; what binned approximates"},
    BuilderInfo{"spatial", "binned, and splits long triangles in space; best for rooms and buildings"},
    BuilderInfo{"linear", "merges neighbours along a space-filling curve; the fastest, for edits"},
};
constexpr std::array<Build, kBuilders.size()> kBuilds = {
    buildAuto,             overBoxes<buildMidpoint>, overBoxes<buildMedian>, overBoxes<buildBinned>,
    overBoxes<buildSweep>, buildSpatial,             overBoxes<buildLinear>,
};

Build findBuilder(std::string_view name) {
    const auto found =
        std::find_if(kBuilders.begin(), kBuilders.end(), [&](const BuilderInfo& info) { return info.name == name; });
    if (found != kBuilders.end()) return kBuilds[static_cast<size_t>(found - kBuilders.begin())];
    std::string known;
    for (const BuilderInfo& info : kBuilders) known.append(known.empty() ? "" : ", ").append(info.name);
    throw Error("BVH: no builder is called '" + std::string(name) + "'; there are " + known);
}

}  // namespace

std::span<const BuilderInfo> builders() { return kBuilders; }

std::vector<std::string> builderNames() {
    std::vector<std::string> names;
    for (const BuilderInfo& info : kBuilders) names.emplace_back(info.name);
    return names;
}

Bvh buildBvh(std::string_view builder, const BuildInput& input, const BvhConfig& config, const BuildControl& control) {
    Bvh bvh = findBuilder(builder)(input, config, control);
    if (control.progress) control.progress(1.0f);
    return bvh;
}

}  // namespace raylab
