#include "engine/measure/build_figures.h"

#include "engine/core/stopwatch.h"
#include "engine/render/triangle_record.h"

namespace raylab {
namespace {

/// Adds the time of the layout to `layoutSeconds`.
TreeFigures measureTree(const Bvh& bvh, const TraceConfig& config, double& layoutSeconds) {
    TreeFigures figures;
    figures.quality = measureQuality(bvh, config.bvh);
    figures.references = bvh.order.size();
    const Stopwatch watch;
    const FlatTree flat = flatten(config.layout, bvh, 0, 0);
    layoutSeconds += watch.seconds();
    figures.nodeBytes = std::as_bytes(std::span(flat.words)).size();
    return figures;
}

/// Of one build, in the order of compareBuilds()' rows.
std::vector<std::optional<double>> valuesOf(const MeasuredBuild& build) {
    std::vector<std::optional<double>> values(9);
    if (build.trees != nullptr) {
        values[0] = build.trees->sah;
        values[6] = 1e3 * build.trees->buildSeconds;
    }
    values[1] = build.epo;
    if (build.walks) {
        values[2] = build.walks->cost;
        values[3] = build.walks->boxes;
        values[4] = build.walks->primitives;
    }
    if (build.figures != nullptr) {
        constexpr double kMebi = 1 << 20;
        values[5] = static_cast<double>(build.figures->bytes()) / kMebi;
        values[7] = 1e3 * build.figures->layoutSeconds;
        double nodes = static_cast<double>(build.figures->upper.quality.nodes);
        for (const TreeFigures& tree : build.figures->trees) nodes += static_cast<double>(tree.quality.nodes);
        values[8] = nodes;
    }
    return values;
}

}  // namespace

BuildFigures measureBuild(const TreeInspection& trees, const TraceConfig& config) {
    BuildFigures figures;
    const TraceData& data = trees.data;
    for (const PrimitiveTree& tree : data.trees)
        figures.trees.push_back(measureTree(tree.bvh, config, figures.layoutSeconds));
    if (!data.upper.nodes.empty()) figures.upper = measureTree(data.upper, config, figures.layoutSeconds);
    figures.nodeBytes = figures.upper.nodeBytes;
    for (const TreeFigures& tree : figures.trees) figures.nodeBytes += tree.nodeBytes;
    const size_t recordBytes = triangleTests()[findTriangleTest(config.triangle)].words * sizeof(glm::uvec4);
    figures.triangleBytes = findLayout(config.layout).blocks ? 0 : data.triangles.size() * recordBytes;
    figures.instanceBytes = std::as_bytes(std::span(data.instances)).size();
    return figures;
}

WalkCost measureWalks(const TreeInspection& trees, std::span<const WalkRay> rays) {
    WalkCost sum{.rays = rays.size()};
    if (rays.empty()) return sum;
    const BvhConfig& costs = trees.config.bvh;
    for (const WalkRay& ray : rays)
        for (const WalkStep& step : walkRay(trees, ray).steps) {
            sum.steps += 1.0;
            sum.boxes += static_cast<double>(step.boxes.size());
            sum.primitives += static_cast<double>(step.primitives.size());
            if (step.kind == WalkKind::inner) sum.cost += static_cast<double>(costs.traversalCost);
            sum.cost += static_cast<double>(costs.intersectionCost) * static_cast<double>(step.primitives.size());
        }
    const auto count = static_cast<double>(rays.size());
    for (double* part : {&sum.steps, &sum.boxes, &sum.primitives, &sum.cost}) *part /= count;
    return sum;
}

std::optional<double> FigurePair::difference() const {
    if (!a || !b || *a == 0.0) return {};
    return *b / *a - 1.0;
}

std::vector<FigurePair> compareBuilds(const MeasuredBuild& a, const MeasuredBuild& b) {
    std::vector<FigurePair> rows = {
        {"SAH", "", "expected cost of a long ray through all trees", {}, {}},
        {"EPO", "", "end-point overlap of the largest tree", {}, {}},
        {"ray cost", "", "inner nodes and primitives that rays of this view meet, times their costs", {}, {}},
        {"boxes", "a ray", "tested, by rays of this view", {}, {}},
        {"primitives", "a ray", "tested, by rays of this view", {}, {}},
        {"memory", "MiB", "nodes in their layout, triangle records, instances", {}, {}},
        {"build", "ms", "of the binary trees", {}, {}},
        {"layout", "ms", "from the binary trees to the layout", {}, {}},
        {"nodes", "", "of the binary trees, leaves included", {}, {}},
    };
    const auto left = valuesOf(a), right = valuesOf(b);
    for (size_t i = 0; i < rows.size(); ++i) {
        rows[i].a = left[i];
        rows[i].b = right[i];
    }
    return rows;
}

}  // namespace raylab
