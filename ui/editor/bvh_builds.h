#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/stopwatch.h"
#include "engine/measure/build_figures.h"
#include "ui/editor/background.h"

namespace raylab {

/// References of a tree whose EPO is measured at most: beyond, it takes a minute and more.
constexpr size_t kMostForEpo = 4'000'000;

/// Trees of the viewport's scene, and what was measured of them so far.
struct SceneBuild {
    std::shared_ptr<const Scene> scene;           ///< that was asked for last
    TraceConfig config;                           ///< the same
    std::shared_ptr<const TreeInspection> trees;  ///< nullptr before the first; stale while `isBuilding`
    std::shared_ptr<const BuildFigures> figures;  ///< of `trees`; comes after them
    std::vector<std::optional<double>> epo;       ///< of each of the trees; comes last
    std::optional<WalkCost> walks;                ///< of the view's rays
    std::shared_ptr<const Scene> shownScene;      ///< that `trees` are of
    bool isBuilding = false;
    std::string error;    ///< why there are none
    uint64_t number = 0;  ///< counts the times that it was asked for
};

/// Builds trees of the scene in a background thread, once by each of two configurations, and measures them. One thread
/// uses it, and never waits.
class BvhBuilds {
public:
    BvhBuilds();
    ~BvhBuilds();
    BvhBuilds(const BvhBuilds&) = delete;
    BvhBuilds& operator=(const BvhBuilds&) = delete;

    /// Sees to it that build `which` will be of the scene and by the configuration: to be called in each frame in which
    /// it is looked at. Edits that touch no geometry cost nothing; others wait until nothing has changed for a moment.
    void want(size_t which, const std::shared_ptr<const Scene>& scene, TraceConfig config);
    /// Measures the rays on both builds; `rays` replace those before.
    void measureView(std::vector<WalkRay> rays);
    /// Takes what has been finished.
    void collect();
    /// Ends what is being built; what was there stays.
    void cancel();
    /// Builds once more, as after cancel().
    void again(size_t which) { builds_[which].scene.reset(); }

    const SceneBuild& operator[](size_t which) const { return builds_[which]; }
    /// What is being done, for people; empty where nothing is.
    std::string busyWith() const { return slow_.busyWith(); }
    /// For what takes some ten milliseconds.
    Background& quick() { return quick_; }

private:
    void start(size_t which);
    void startFigures(size_t which);
    void startEpo(size_t which, uint32_t tree);
    void startWalks(size_t which);
    bool isCurrent(size_t which, uint64_t number) const { return builds_[which].number == number; }

    std::array<SceneBuild, 2> builds_;
    std::array<Stopwatch, 2> sinceChange_;
    std::array<bool, 2> waits_{};  ///< has been asked for, and was not started yet
    std::array<std::shared_ptr<std::atomic<bool>>, 2> cancels_;
    std::shared_ptr<const std::vector<WalkRay>> rays_;
    Background slow_;
    Background quick_;
};

}  // namespace raylab
