#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/measure/bench_rays.h"

namespace raylab {

/// What a row of a benchmark says about who traced; a peer has a name in `tracer` and nothing else.
struct SubjectLabel {
    std::string tracer;
    std::string layout;
    std::string triangle;
    std::string builder;
    std::string variation;  ///< settings that were varied beyond those
};

/// Answers of a subject, to compare with the others'.
struct TracedRays {
    double seconds = 0.0;  ///< for all rays, without upload and download
    size_t hits = 0;
};

/// Work per ray, from a kernel that counts.
struct RayCounters {
    double nodes = 0.0;
    double triangles = 0.0;
    double instances = 0.0;
    double balance =
        0.0;  ///< nodes of all rays over those of groups of 8 neighbours that all walk as long as their longest
};

/// What a software traversal fetches for a ray on average, in bytes: nodes of the layout, triangles as the test stores
/// them, and instances. A tracer that walks no tree fetches triangles alone. Throws Error for names that no table
/// holds.
double bytesPerRay(const SubjectLabel& label, const RayCounters& counters);

/// Somebody who traces rays.
class BenchSubject {
public:
    virtual ~BenchSubject() = default;
    virtual SubjectLabel label() const = 0;
    virtual TracedRays trace(const RaySet& rays) = 0;
    /// Nothing where the subject cannot count.
    virtual std::optional<RayCounters> count(const RaySet& rays) = 0;
};

struct BenchRow {
    SubjectLabel label;
    std::string rayKind;
    size_t rays = 0;
    size_t hits = 0;
    double mraysPerSecond = 0.0;  ///< median of the repeats
    double low = 0.0;  ///< interval of order statistics that covers the median with at least 93 %, or all there is
    double high = 0.0;
    std::optional<RayCounters> counters;
};

/// Times every subject on every set of rays, `repeats` times after one warm-up, the subjects in turn and each round
/// from another one on, so that a drifting machine favours none. Where `stop` says so, between two timings, only the
/// sets that are done have rows.
std::vector<BenchRow> runRayBench(std::span<const std::unique_ptr<BenchSubject>> subjects, std::span<const RaySet> sets,
                                  int repeats, const std::function<bool()>& stop);

/// A configuration of raylab on the device.
std::unique_ptr<BenchSubject> makeDeviceSubject(Device& device, const Scene& scene, const RenderSettings& settings,
                                                const std::string& variation);

/// Everybody who traces on the CPU, on as many threads as TBB has: "scalar", our walk of the 32-byte nodes, one ray
/// after another; and, where raylab was built with it, Embree (Wald et al., SIGGRAPH 2014) with single rays, single
/// rays and its robust flag, and packets of 8 and 16.
std::vector<std::unique_ptr<BenchSubject>> makePeerSubjects(const Scene& scene);

/// All instances in world space.
struct WorldTriangles {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    std::vector<glm::uvec2> ids;  ///< of each: instance, primitive
};
WorldTriangles worldTriangles(const Scene& scene);

}  // namespace raylab
