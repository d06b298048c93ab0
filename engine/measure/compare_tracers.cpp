#include "engine/measure/compare_tracers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/render/camera.h"

namespace raylab {
namespace {

/// Rays of a call to a caster, and of a dispatch: their index in it is their key.
constexpr size_t kBatch = size_t{1} << 16;

bool isHit(const shared::HitData& hit) { return hit.t >= 0.0f; }

/// Floats from 0 up order like their bits.
uint32_t ulpsBetween(float a, float b) {
    const auto x = std::bit_cast<uint32_t>(a), y = std::bit_cast<uint32_t>(b);
    return x > y ? x - y : y - x;
}

double relativeDifference(float a, float b) {
    const double x = static_cast<double>(a), y = static_cast<double>(b);
    return std::abs(x - y) / std::max({std::abs(x), std::abs(y), 1e-300});
}

/// How two answers differ: counts of one ray, without the oracle's.
DifferenceCounts differenceOf(const shared::HitData& a, const shared::HitData& b, bool anyHit) {
    DifferenceCounts d;
    d.rays = 1;
    d.hitMiss = isHit(a) != isHit(b) ? 1 : 0;
    if (anyHit || !isHit(a) || !isHit(b)) return d;
    d.instance = a.instance != b.instance ? 1 : 0;
    d.primitive = d.instance == 0 && a.primitive != b.primitive ? 1 : 0;
    d.t = relativeDifference(a.t, b.t) > kSameT ? 1 : 0;
    d.tUlp1 = ulpsBetween(a.t, b.t) > 1 ? 1 : 0;
    d.tUlp4 = ulpsBetween(a.t, b.t) > 4 ? 1 : 0;
    const double apart = static_cast<double>(std::max(std::abs(a.u - b.u), std::abs(a.v - b.v)));
    d.barycentrics = d.instance + d.primitive == 0 && !(apart <= kSameBarycentrics) ? 1 : 0;
    return d;
}

RayState stateOf(Verdict verdict) {
    switch (verdict) {
        case Verdict::aRight:
            return RayState::bWrong;
        case Verdict::bRight:
            return RayState::aWrong;
        case Verdict::neither:
            return RayState::bothWrong;
        case Verdict::tie:
            return RayState::tie;
        case Verdict::undecidable:
            return RayState::undecidable;
    }
    return RayState::undecidable;
}

void countVerdict(RayState state, DifferenceCounts& counts) {
    counts.aWrong += state == RayState::aWrong ? 1 : 0;
    counts.bWrong += state == RayState::bWrong ? 1 : 0;
    counts.bothWrong += state == RayState::bothWrong ? 1 : 0;
    counts.ties += state == RayState::tie ? 1 : 0;
    counts.undecidable += state == RayState::undecidable ? 1 : 0;
}

bool isWrong(RayState state) {
    return state == RayState::aWrong || state == RayState::bWrong || state == RayState::bothWrong;
}

struct Batch {
    const RayKind& kind;
    std::span<const shared::RayData> rays;
    std::vector<shared::HitData> a, b;
    std::vector<DifferenceCounts> counts;
    std::vector<RayState> states;
    std::vector<TrueHit> truths;
};

Batch compareBatch(HitSource& a, HitSource& b, const HitOracle& oracle, const RayKind& kind,
                   std::span<const shared::RayData> rays) {
    Batch batch{kind,
                rays,
                kind.anyHit ? a.occluded(rays) : a.closest(rays),
                kind.anyHit ? b.occluded(rays) : b.closest(rays),
                std::vector<DifferenceCounts>(rays.size()),
                std::vector<RayState>(rays.size(), RayState::equal),
                std::vector<TrueHit>(rays.size())};
    tbb::parallel_for(size_t{0}, rays.size(), [&](size_t i) {
        DifferenceCounts& counts = batch.counts[i];
        counts = differenceOf(batch.a[i], batch.b[i], kind.anyHit);
        if (counts.tUlp4 != 0) batch.states[i] = RayState::tOnly;
        if (counts.hitMiss + counts.instance + counts.primitive + counts.t == 0) return;
        const auto key = static_cast<uint32_t>(i);
        const Judgement judgement = kind.anyHit ? oracle.judgeOccluded(rays[i], key, batch.a[i], batch.b[i])
                                                : oracle.judgeClosest(rays[i], key, batch.a[i], batch.b[i]);
        batch.states[i] = stateOf(judgement.verdict);
        batch.truths[i] = judgement.truth;
        countVerdict(batch.states[i], counts);
    });
    return batch;
}

/// Of `total` rays that come in several lists, `wanted` evenly.
class Thinning {
public:
    Thinning(uint64_t total, uint64_t wanted) : total_(total), wanted_(std::min(wanted, total)) {}

    std::vector<shared::RayData> keep(const std::vector<shared::RayData>& rays) {
        if (wanted_ == total_) return rays;
        std::vector<shared::RayData> kept;
        for (const shared::RayData& ray : rays) {
            const uint64_t before = reached();
            ++seen_;
            if (reached() > before) kept.push_back(ray);
        }
        return kept;
    }

private:
    uint64_t reached() const {
        return static_cast<uint64_t>(static_cast<double>(seen_) * static_cast<double>(wanted_) /
                                     static_cast<double>(total_));
    }

    uint64_t total_;
    uint64_t wanted_;
    uint64_t seen_ = 0;
};

/// From the second round on, the camera turned by a part of a pixel: the R2 sequence of Roberts, "The Unreasonable
/// Effectiveness of Quasirandom Sequences", 2018.
BenchView viewOfRound(const BenchView& view, uint32_t round) {
    BenchView result = view;
    result.seed = view.seed + round;
    if (round == 0) return result;
    shared::FrameParams frame{};
    writeCamera(view.camera, view.width, view.height, frame);
    const auto offset = [round](double step) {
        const double x = step * round;
        return static_cast<float>(x - std::floor(x) - 0.5);
    };
    const glm::vec3 turn = offset(0.7548776662466927) * 2.0f / static_cast<float>(view.width) * frame.cameraRight +
                           offset(0.5698402909980532) * 2.0f / static_cast<float>(view.height) * frame.cameraUp;
    result.camera.target =
        frame.cameraPosition + glm::length(view.camera.target - view.camera.position) * (frame.cameraForward + turn);
    return result;
}

/// Paints primary rays where they came from.
class HeatPainter {
public:
    HeatPainter(const ComparePlan& plan, const HitOracle& oracle)
        : oracle_(oracle),
          heat_(plan.heat ? static_cast<int>(plan.view.width) : 0, plan.heat ? static_cast<int>(plan.view.height) : 0,
                3) {
        writeCamera(plan.view.camera, plan.view.width, plan.view.height, frame_);
    }

    void paint(const Batch& batch) {
        if (heat_.pixels.empty()) return;
        tbb::parallel_for(size_t{0}, batch.rays.size(), [&](size_t i) {
            const glm::ivec2 pixel = pixelOf(batch.rays[i].direction);
            if (glm::any(glm::lessThan(pixel, glm::ivec2(0))) || pixel.x >= heat_.width || pixel.y >= heat_.height)
                return;
            const RayStateInfo& info = kRayStates[static_cast<size_t>(batch.states[i])];
            float shade = 1.0f;
            if (info.state == RayState::equal)
                shade = isHit(batch.a[i]) ? 0.1f + 0.9f * static_cast<float>(oracle_.facing(batch.rays[i], batch.a[i]))
                                          : 0.02f;
            for (size_t c = 0; c < 3; ++c) heat_.at(pixel.x, pixel.y)[c] = shade * info.rgb[c];
        });
    }
    Bitmap take() { return std::move(heat_); }

private:
    glm::ivec2 pixelOf(const glm::vec3& direction) const {
        const glm::vec3 d = direction / glm::dot(direction, frame_.cameraForward);
        const glm::vec2 ndc(glm::dot(d, frame_.cameraRight) / glm::dot(frame_.cameraRight, frame_.cameraRight),
                            -glm::dot(d, frame_.cameraUp) / glm::dot(frame_.cameraUp, frame_.cameraUp));
        return {glm::floor((ndc + 1.0f) * 0.5f * glm::vec2(heat_.width, heat_.height))};
    }

    const HitOracle& oracle_;
    shared::FrameParams frame_{};
    Bitmap heat_;
};

class Comparer {
public:
    Comparer(HitSource& a, HitSource& b, const Scene& scene, const ComparePlan& plan, const CompareProgress& progress)
        : a_(a), b_(b), scene_(scene), plan_(plan), progress_(progress), oracle_(scene), painter_(plan, oracle_) {
        for (const RayKind& kind : kRayKinds) result_.kinds.push_back({kind, {}});
    }

    RayComparison run() {
        bool goesOn = true;
        for (uint32_t round = 0; goesOn && done_ < plan_.rays; ++round) goesOn = compareRound(round);
        result_.complete = goesOn;
        std::vector<Offender>& listed = result_.offenders;
        listed.insert(listed.end(), undecidable_.begin(), undecidable_.end());
        listed.resize(std::min(listed.size(), plan_.offenders));
        result_.heat = painter_.take();
        return std::move(result_);
    }

private:
    bool compareRound(uint32_t round) {
        const std::vector<RaySet> sets = makeBenchRays(a_, scene_, viewOfRound(plan_.view, round));
        uint64_t ofRound = 0;
        for (const RaySet& set : sets) ofRound += set.rays.size();
        Thinning thinning(ofRound, plan_.rays - done_);
        for (size_t kind = 0; kind < sets.size(); ++kind) {
            const std::vector<shared::RayData> rays = thinning.keep(sets[kind].rays);
            for (size_t first = 0; first < rays.size(); first += kBatch)
                if (!compare(kind, round, std::span(rays).subspan(first, std::min(kBatch, rays.size() - first))))
                    return false;
        }
        return true;
    }

    /// False where progress says stop and rays are left.
    bool compare(size_t kind, uint32_t round, std::span<const shared::RayData> rays) {
        const Batch batch = compareBatch(a_, b_, oracle_, kRayKinds[kind], rays);
        for (const DifferenceCounts& counts : batch.counts) result_.kinds[kind].counts.add(counts);
        if (round == 0 && kind == 0) painter_.paint(batch);
        keepOffenders(batch);
        done_ += rays.size();
        return progress_(static_cast<double>(done_) / static_cast<double>(plan_.rays)) || done_ >= plan_.rays;
    }

    void keepOffenders(const Batch& batch) {
        for (size_t i = 0; i < batch.rays.size(); ++i) {
            const RayState state = batch.states[i];
            if (!isWrong(state) && state != RayState::undecidable) continue;
            std::vector<Offender>& list = isWrong(state) ? result_.offenders : undecidable_;
            if (list.size() >= plan_.offenders) continue;
            list.push_back({batch.kind.name, batch.kind.anyHit, static_cast<uint32_t>(i), batch.rays[i], batch.a[i],
                            batch.b[i], batch.truths[i], state});
        }
    }

    HitSource& a_;
    HitSource& b_;
    const Scene& scene_;
    const ComparePlan& plan_;
    const CompareProgress& progress_;
    HitOracle oracle_;
    HeatPainter painter_;
    RayComparison result_;
    std::vector<Offender> undecidable_;
    uint64_t done_ = 0;
};

}  // namespace

void DifferenceCounts::add(const DifferenceCounts& other) {
    for (const auto member :
         {&DifferenceCounts::rays, &DifferenceCounts::hitMiss, &DifferenceCounts::instance,
          &DifferenceCounts::primitive, &DifferenceCounts::t, &DifferenceCounts::tUlp1, &DifferenceCounts::tUlp4,
          &DifferenceCounts::barycentrics, &DifferenceCounts::aWrong, &DifferenceCounts::bWrong,
          &DifferenceCounts::bothWrong, &DifferenceCounts::ties, &DifferenceCounts::undecidable})
        this->*member += other.*member;
}

DifferenceCounts RayComparison::total() const {
    DifferenceCounts sum;
    for (const KindCounts& kind : kinds) sum.add(kind.counts);
    return sum;
}

RayComparison compareRays(HitSource& a, HitSource& b, const Scene& scene, const ComparePlan& plan,
                          const CompareProgress& progress) {
    return Comparer(a, b, scene, plan, progress).run();
}

}  // namespace raylab
