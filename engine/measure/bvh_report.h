#pragma once

#include <optional>
#include <string>

#include "engine/accel/quality.h"
#include "engine/render/trace_data.h"

namespace raylab {

/// Figures of all trees of a scene.
struct BvhReport {
    std::string builder;
    std::string layout;
    std::string triangle;
    double sah = 0.0;           ///< of the walk through the upper tree and the trees below it
    std::optional<double> epo;  ///< of the tree with the most triangles; takes seconds
    BvhQuality largest;         ///< of that tree
    int depth = 0;              ///< of the deepest tree below the upper one, and of that
    size_t trees = 0;           ///< over triangles
    size_t nodes = 0;           ///< of all binary trees, leaves included
    size_t flatNodes = 0;       ///< of the layout: blocks, where it is one of blocks
    size_t nodeBytes = 0;       ///< with the triangles, where they stand among the nodes
    size_t triangleBytes = 0;
    size_t instanceBytes = 0;
    double buildMs = 0.0;             ///< of all trees, flattened
    std::optional<double> flattenMs;  ///< of that, for the tree with the most triangles
    size_t duplicates = 0;            ///< triangles that trees list again in other leaves
    size_t skipped = 0;               ///< degenerate triangles, left out

    size_t bytes() const { return nodeBytes + triangleBytes + instanceBytes; }
};

enum class BvhDetail { quick, full };

/// Builds the trees of a scene as the software tracer does, and measures them. `epo` and `flattenMs` come with `full`
/// alone. Throws Error as buildTraceData() does.
BvhReport measureBvh(const Scene& scene, const TraceConfig& config, BvhDetail detail);

/// Expected cost of a long ray through the trees that buildTraceData() built by `config`: of the upper tree's inner
/// nodes, and for each of its leaves that of the tree below.
double combinedSah(const TraceData& data, const TraceConfig& config);

}  // namespace raylab
