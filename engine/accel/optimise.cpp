#include "engine/accel/optimise.h"

#include <algorithm>
#include <utility>

#include "engine/accel/build_links.h"
#include "engine/accel/build_range.h"
#include "engine/accel/build_reinsertion.h"
#include "engine/accel/quality.h"
#include "engine/core/stopwatch.h"

namespace raylab {
namespace {

/// A round looks at one node in so many.
constexpr size_t kStride = 8;
constexpr double kLeastGain = 1e-3;  ///< of kStride rounds together, as a part of the area of inner nodes
constexpr size_t kSearches = 512;    ///< that one task makes
constexpr double kProgress = 1e6;    ///< units of progress

/// The moves that pay, in the tree as it is, best first.
std::vector<Reinsertion> searchRound(const ReinsertionTree& tree, size_t round) {
    const size_t first = round % kStride;
    const size_t count = (tree.nodes().size() + kStride - 1 - first) / kStride;
    std::vector<Reinsertion> moves(count);
    parallelFor((count + kSearches - 1) / kSearches, [&](size_t part) {
        std::vector<std::pair<uint32_t, float>> stack;
        for (size_t i = part * kSearches; i < std::min(count, (part + 1) * kSearches); ++i)
            moves[i] = tree.search(static_cast<uint32_t>(first + i * kStride), stack);
    });
    std::erase_if(moves, [](const Reinsertion& move) { return move.target == kNoNode; });
    std::sort(moves.begin(), moves.end(), [](const Reinsertion& a, const Reinsertion& b) {
        return a.gain != b.gain ? a.gain > b.gain : a.node < b.node;
    });
    return moves;
}

/// Whether some primitive is listed twice.
bool hasDuplicates(const Bvh& bvh) {
    std::vector<bool> seen;
    for (const uint32_t id : bvh.order) {
        if (id >= seen.size()) seen.resize(size_t{id} + 1);
        if (seen[id]) return true;
        seen[id] = true;
    }
    return false;
}

/// The tree that reinsertion left, over the leaves of the Bvh.
Bvh rebuild(const ReinsertionTree& tree, const Bvh& bvh, const BvhConfig& config) {
    LinkedTree linked((bvh.nodes.size() + 1) / 2, bvh.order, config);
    linked.maxLeafSize = hasDuplicates(bvh) ? 0 : linked.maxLeafSize;
    linked.maxDepth = std::max(config.maxDepth, static_cast<int>(bvh.depth));
    linked.unitsPerLeaf = 1;
    std::vector<uint32_t> children(bvh.nodes.size());  // in `linked`, of each node
    std::vector<uint32_t> inner;                       // parents before their children
    std::vector<uint32_t> stack = {0};
    uint32_t unit = 0;
    while (!stack.empty()) {
        const uint32_t index = stack.back();
        stack.pop_back();
        const ReinsertionTree::Node& node = tree.nodes()[index];
        if (node.isLeaf()) {
            const BvhNode& leaf = bvh.nodes[index];
            linked.units[unit] = {leaf.bounds, leaf.first, leaf.count};
            children[index] = unit++;
        } else {
            inner.push_back(index);
            stack.push_back(node.right);
            stack.push_back(node.left);
        }
    }
    std::reverse(inner.begin(), inner.end());
    for (size_t i = 0; i < inner.size(); ++i) {
        const ReinsertionTree::Node& node = tree.nodes()[inner[i]];
        linked.join(i, children[node.left], children[node.right]);
        children[inner[i]] = static_cast<uint32_t>(linked.unitCount + i);
    }
    Bvh result = toBvh(linked);
    result.skipped = bvh.skipped;
    return result;
}

/// Of the budget.
double usedPart(const OptimiseBudget& budget, double seconds, int rounds) {
    return std::min(1.0, std::max(seconds / budget.seconds, static_cast<double>(rounds) / budget.rounds));
}

}  // namespace

OptimiseResult optimise(Bvh& bvh, const BvhConfig& config, const OptimiseBudget& budget, const BuildControl& control) {
    checkConfig(config, 0);
    OptimiseResult result;
    if (bvh.nodes.empty()) return result;
    result.sahBefore = result.sahAfter = measureQuality(bvh, config).sah;
    const Stopwatch time;
    BuildMonitor monitor(control, static_cast<size_t>(kProgress));
    ReinsertionTree tree(bvh);
    double area = tree.innerArea();
    double gained = 0.0;
    double used = 0.0;
    while (!result.converged && time.seconds() < budget.seconds && result.rounds < budget.rounds) {
        for (const Reinsertion& move : searchRound(tree, static_cast<size_t>(result.rounds))) {
            const double gain = tree.apply(move);
            gained += gain;
            result.moves += gain > 0.0 ? 1 : 0;
        }
        monitor.check();
        if (++result.rounds % static_cast<int>(kStride) == 0) {
            result.converged = gained <= kLeastGain * area;
            area -= std::exchange(gained, 0.0);
        }
        const double before = std::exchange(used, usedPart(budget, time.seconds(), result.rounds));
        monitor.advance(static_cast<size_t>((used - before) * kProgress));
    }
    Bvh better = rebuild(tree, bvh, config);
    const double sah = measureQuality(better, config).sah;
    if (sah < result.sahBefore) {
        result.sahAfter = sah;
        bvh = std::move(better);
    }
    if (control.progress) control.progress(1.0f);
    return result;
}

}  // namespace raylab
