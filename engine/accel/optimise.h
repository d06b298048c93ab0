#pragma once

#include <cstddef>
#include <limits>

#include "engine/accel/build_input.h"
#include "engine/accel/bvh.h"

namespace raylab {

/// When optimise() stops: at the first of these, or when nothing is gained any more.
struct OptimiseBudget {
    double seconds = std::numeric_limits<double>::infinity();  ///< looked at between rounds
    int rounds = 64;
};

struct OptimiseResult {
    double sahBefore = 0.0;  ///< as of measureQuality()
    double sahAfter = 0.0;   ///< not above sahBefore
    int rounds = 0;
    size_t moves = 0;  ///< subtrees that were put elsewhere
    bool converged = false;
};

/// Lowers the SAH cost of a tree by taking subtrees out and putting each where it costs least: Meister and Bittner,
/// "Parallel Reinsertion for Bounding Volume Hierarchy Optimization", EG 2018. A round searches the best place for one
/// node in eight, in parallel, in the tree as it is (section 3.1, branch and bound up from the node), and then makes
/// the moves one after the other, the best first, each if it still pays: so no two can conflict, and every move lowers
/// the cost. Ends when eight rounds gain less than a thousandth.
///
/// Leaves stay as they are, but small subtrees become leaves in the end where SAH says so (not in a tree with
/// duplicates, which could meet in one leaf). The result has the order of nodes that Bvh documents; it depends on the
/// time that the rounds take where budget.seconds ends them, and on nothing else. Never deeper than config.maxDepth or
/// the tree was, whichever is more. Throws Error for a config out of its ranges; Cancelled, and then leaves the tree as
/// it was.
OptimiseResult optimise(Bvh& bvh, const BvhConfig& config = {}, const OptimiseBudget& budget = {},
                        const BuildControl& control = {});

}  // namespace raylab
