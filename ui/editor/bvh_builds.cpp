#include "ui/editor/bvh_builds.h"

#include <tuple>
#include <utility>

#include "engine/core/error.h"
#include "ui/editor/model/edit_kinds.h"
#include "ui/editor/window.h"

namespace raylab {
namespace {

constexpr double kRestSeconds = 0.3;  ///< without a change, until trees are built anew

bool sameTrees(const TraceConfig& a, const TraceConfig& b) {
    const auto key = [](const TraceConfig& c) {
        return std::tuple(c.builder, c.layout, c.triangle, c.paddedSlab, c.bvh.bins, c.bvh.maxLeafSize,
                          c.bvh.traversalCost, c.bvh.intersectionCost, c.bvh.spatialBudget, c.reinsertionPasses,
                          c.flattenLimit, c.trees);
    };
    return key(a) == key(b);
}

bool sameGeometry(const std::shared_ptr<const Scene>& a, const std::shared_ptr<const Scene>& b) {
    if (a == b) return true;
    if (a == nullptr || b == nullptr) return false;
    return (editor::editKinds(*a, *b) & (editor::kEditTransforms | editor::kEditGeometry)) == 0;
}

/// What a build came to.
struct Outcome {
    std::shared_ptr<TreeInspection> trees;
    std::string error;
};

Outcome build(const Scene& scene, const TraceConfig& config, const std::atomic<bool>& cancel, JobControl& job) {
    BuildControl control;
    control.cancel = &cancel;
    control.progress = [&](float part) {
        job.report("Building the trees  " + std::to_string(static_cast<int>(100.0f * part)) + " %");
    };
    try {
        return {std::make_shared<TreeInspection>(inspectTrees(scene, config, control)), ""};
    } catch (const Cancelled&) {
        return {nullptr, "cancelled"};
    } catch (const Error& error) {
        return {nullptr, error.what()};
    }
}

}  // namespace

BvhBuilds::BvhBuilds() : slow_(wakeWindow), quick_(wakeWindow) {}

BvhBuilds::~BvhBuilds() { cancel(); }

void BvhBuilds::cancel() {
    for (const auto& flag : cancels_)
        if (flag != nullptr) *flag = true;
}

void BvhBuilds::collect() {
    slow_.collect();
    quick_.collect();
}

void BvhBuilds::want(size_t which, const std::shared_ptr<const Scene>& scene, TraceConfig config) {
    SceneBuild& mine = builds_[which];
    config.cache = false;  // the time of a build is one of its figures
    const bool isSame = sameGeometry(mine.scene, scene) && sameTrees(mine.config, config);
    const bool isFirst = mine.scene == nullptr;
    mine.scene = scene;
    if (!isSame) {
        mine.config = std::move(config);
        mine.isBuilding = waits_[which] = true;
        ++mine.number;
        if (cancels_[which] != nullptr) *cancels_[which] = true;
        sinceChange_[which].restart();
    }
    if (waits_[which] && (isFirst || sinceChange_[which].seconds() >= kRestSeconds)) start(which);
}

void BvhBuilds::start(size_t which) {
    waits_[which] = false;
    const auto cancel = cancels_[which] = std::make_shared<std::atomic<bool>>(false);
    const SceneBuild& mine = builds_[which];
    slow_.start("Building the trees",
                [this, which, cancel, scene = mine.scene, config = mine.config,
                 number = mine.number](JobControl& job) -> Background::Finish {
                    const Outcome outcome = build(*scene, config, *cancel, job);
                    return [this, which, outcome, scene, number] {
                        if (!isCurrent(which, number)) return;
                        SceneBuild& done = builds_[which];
                        done.isBuilding = false;
                        done.error = outcome.error;
                        if (outcome.trees == nullptr) return;
                        done.trees = outcome.trees;
                        done.shownScene = scene;
                        done.figures.reset();
                        done.walks.reset();
                        done.epo.assign(outcome.trees->data.trees.size(), std::nullopt);
                        startFigures(which);
                        startWalks(which);
                    };
                });
}

void BvhBuilds::startFigures(size_t which) {
    const SceneBuild& mine = builds_[which];
    slow_.start("Measuring the trees",
                [this, which, trees = mine.trees, config = mine.config,
                 number = mine.number](JobControl&) -> Background::Finish {
                    auto figures = std::make_shared<const BuildFigures>(measureBuild(*trees, config));
                    return [this, which, figures, number] {
                        if (!isCurrent(which, number)) return;
                        builds_[which].figures = figures;
                        startEpo(which, 0);
                    };
                });
}

/// Tree by tree, so that nothing else waits for all of them.
void BvhBuilds::startEpo(size_t which, uint32_t tree) {
    const SceneBuild& mine = builds_[which];
    while (tree < mine.epo.size() && mine.trees->data.trees[tree].slotCount > kMostForEpo) ++tree;
    if (tree >= mine.epo.size()) return;
    const std::string text = "EPO of tree " + std::to_string(tree + 1) + " of " + std::to_string(mine.epo.size());
    slow_.start(text, [this, which, tree, trees = mine.trees, number = mine.number](JobControl&) -> Background::Finish {
        const double epo = measureTreeEpo(*trees, tree);
        return [this, which, tree, epo, number] {
            if (!isCurrent(which, number)) return;
            builds_[which].epo[tree] = epo;
            startEpo(which, tree + 1);
        };
    });
}

void BvhBuilds::measureView(std::vector<WalkRay> rays) {
    rays_ = std::make_shared<const std::vector<WalkRay>>(std::move(rays));
    for (size_t which = 0; which < builds_.size(); ++which) startWalks(which);
}

void BvhBuilds::startWalks(size_t which) {
    const SceneBuild& mine = builds_[which];
    if (rays_ == nullptr || mine.trees == nullptr) return;
    quick_.start("Walking rays", [this, which, trees = mine.trees, rays = rays_](JobControl&) -> Background::Finish {
        const WalkCost cost = measureWalks(*trees, *rays);
        return [this, which, trees, rays, cost] {
            if (rays == rays_ && trees == builds_[which].trees) builds_[which].walks = cost;
        };
    });
}

}  // namespace raylab
