#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/measure/ray_walk.h"

namespace raylab {

/// One tree of a build.
struct TreeFigures {
    BvhQuality quality;     ///< without `epo`, which takes long: measureTreeEpo()
    size_t references = 0;  ///< to primitives
    size_t nodeBytes = 0;   ///< in the layout; with the triangles where they stand among the nodes
};

/// What a ray meets on its way, on average.
struct WalkCost {
    size_t rays = 0;
    double steps = 0.0;  ///< of the walk's loop
    double boxes = 0.0;  ///< tested
    double primitives = 0.0;
    /// traversalCost for each inner node opened, intersectionCost for each primitive tested: what the SAH expects of
    /// rays that it knows nothing about, measured for these.
    double cost = 0.0;
};

/// A build in numbers.
struct BuildFigures {
    std::vector<TreeFigures> trees;
    TreeFigures upper;
    size_t nodeBytes = 0;      ///< of all trees
    size_t triangleBytes = 0;  ///< records besides the nodes; 0 where the triangles are among them
    size_t instanceBytes = 0;
    double layoutSeconds = 0.0;  ///< to bring the binary trees into the layout

    size_t bytes() const { return nodeBytes + triangleBytes + instanceBytes; }
};

/// `config`: the one that `trees` were asked for, whose layout need not be that of the inspection.
BuildFigures measureBuild(const TreeInspection& trees, const TraceConfig& config);

/// Walks the rays; zero for none.
WalkCost measureWalks(const TreeInspection& trees, std::span<const WalkRay> rays);

/// A chosen measure of two builds, for people.
struct FigurePair {
    std::string name;
    std::string unit;
    std::string help;
    std::optional<double> a, b;  ///< nothing where it has not been measured

    /// b relative to a, -0.1 for ten per cent less; nothing where either is missing or a is 0.
    std::optional<double> difference() const;
};

/// What of one build is compared with another's.
struct MeasuredBuild {
    const TreeInspection* trees = nullptr;
    const BuildFigures* figures = nullptr;
    std::optional<double> epo;  ///< of the tree with the most primitives
    std::optional<WalkCost> walks;
};

/// Rows of the comparison: less is better in all.
std::vector<FigurePair> compareBuilds(const MeasuredBuild& a, const MeasuredBuild& b);

}  // namespace raylab
