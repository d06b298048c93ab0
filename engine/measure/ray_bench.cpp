#include "engine/measure/ray_bench.h"

#include <algorithm>
#include <cmath>

#include "engine/accel/layout.h"
#include "engine/render/device_defaults.h"
#include "engine/render/triangle_record.h"

namespace raylab {
namespace {

class DeviceSubject : public BenchSubject {
public:
    DeviceSubject(Device& device, const Scene& scene, const RenderSettings& settings, std::string variation)
        : settings_(resolveForDevice(settings, device.description(), scene)),
          variation_(std::move(variation)),
          caster_(device, scene, settings_) {}

    SubjectLabel label() const override {
        const TracerInfo& tracer = caster_.prepared().tracer->info();
        if (tracer.driverStructures) return {std::string(tracer.name), "", "", settings_.builder, variation_};
        return {std::string(tracer.name), settings_.layout, settings_.triangle, settings_.builder, variation_};
    }
    TracedRays trace(const RaySet& set) override {
        const std::vector<shared::HitData> hits =
            set.kind.anyHit ? caster_.occluded(set.rays) : caster_.closest(set.rays);
        const auto isHit = [](const shared::HitData& hit) { return hit.t >= 0.0f; };
        return {caster_.traceSeconds(), static_cast<size_t>(std::count_if(hits.begin(), hits.end(), isHit))};
    }
    std::optional<RayCounters> count(const RaySet& set) override {
        if (set.rays.empty() || caster_.prepared().tracer->info().driverStructures) return std::nullopt;
        constexpr size_t kGroup = 8;
        const std::vector<shared::RayCounts> counts = caster_.count(set.rays, set.kind.anyHit).counts;
        RayCounters sum;
        double longest = 0.0;
        for (size_t first = 0; first < counts.size(); first += kGroup) {
            uint32_t most = 0;
            for (size_t i = first; i < std::min(first + kGroup, counts.size()); ++i) {
                sum.nodes += counts[i].nodes;
                sum.triangles += counts[i].primitivesTested;
                sum.instances += counts[i].instances;
                most = std::max(most, counts[i].nodes);
            }
            longest += static_cast<double>(most * kGroup);
        }
        const double scale = 1.0 / static_cast<double>(set.rays.size());
        return RayCounters{sum.nodes * scale, sum.triangles * scale, sum.instances * scale, sum.nodes / longest};
    }

private:
    RenderSettings settings_;
    std::string variation_;
    RayCaster caster_;
};

/// Sorted times; the k-th smallest and largest enclose the median with probability 1 - 2 * sum_{i<k} C(n, i) / 2^n.
size_t intervalRank(size_t count) {
    constexpr double kCoverage = 0.93;
    double tail = std::pow(0.5, static_cast<double>(count));
    double sum = tail;
    size_t rank = 0;
    while (rank + 1 < (count + 1) / 2) {
        tail *= static_cast<double>(count - rank) / static_cast<double>(rank + 1);
        if (1.0 - 2.0 * (sum + tail) < kCoverage) break;
        sum += tail;
        ++rank;
    }
    return rank;
}

BenchRow makeRow(const SubjectLabel& label, const RaySet& set, size_t hits, std::vector<double> seconds) {
    std::sort(seconds.begin(), seconds.end());
    const size_t rank = intervalRank(seconds.size());
    const double mega = static_cast<double>(set.rays.size()) * 1e-6;
    const double median = 0.5 * (seconds[seconds.size() / 2] + seconds[(seconds.size() - 1) / 2]);
    return {label,
            std::string(set.kind.name),
            set.rays.size(),
            hits,
            mega / median,
            mega / seconds[seconds.size() - 1 - rank],
            mega / seconds[rank],
            std::nullopt};
}

}  // namespace

double bytesPerRay(const SubjectLabel& label, const RayCounters& counters) {
    const double triangleWords = triangleTests()[findTriangleTest(label.triangle)].words;
    const double words = counters.nodes * findLayout(label.layout).wordsPerNode + counters.triangles * triangleWords +
                         counters.instances * shared::kWordsTraceInstance;
    return words * sizeof(glm::uvec4);
}

std::vector<BenchRow> runRayBench(std::span<const std::unique_ptr<BenchSubject>> subjects, std::span<const RaySet> sets,
                                  int repeats, const std::function<bool()>& stop) {
    std::vector<BenchRow> rows;
    for (const RaySet& set : sets) {
        if (set.rays.empty()) continue;
        std::vector<std::vector<double>> seconds(subjects.size());
        std::vector<size_t> hits(subjects.size());
        for (size_t i = 0; i < subjects.size(); ++i) {
            if (stop()) return rows;
            hits[i] = subjects[i]->trace(set).hits;  // compiles, fills caches
        }
        for (int round = 0; round < repeats; ++round)
            for (size_t turn = 0; turn < subjects.size(); ++turn) {
                if (stop()) return rows;
                const size_t i = (turn + static_cast<size_t>(round)) % subjects.size();
                seconds[i].push_back(subjects[i]->trace(set).seconds);
            }
        for (size_t i = 0; i < subjects.size(); ++i) {
            rows.push_back(makeRow(subjects[i]->label(), set, hits[i], seconds[i]));
            rows.back().counters = subjects[i]->count(set);
        }
    }
    return rows;
}

std::unique_ptr<BenchSubject> makeDeviceSubject(Device& device, const Scene& scene, const RenderSettings& settings,
                                                const std::string& variation) {
    return std::make_unique<DeviceSubject>(device, scene, settings, variation);
}

WorldTriangles worldTriangles(const Scene& scene) {
    WorldTriangles world;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto base = static_cast<uint32_t>(world.positions.size());
        for (const glm::vec3& p : mesh.positions)
            world.positions.emplace_back(glm::dmat4(instance.objectToWorld) * glm::dvec4(p, 1.0));
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            world.triangles.push_back(mesh.triangles[t] + base);
            world.ids.emplace_back(i, t);
        }
    }
    return world;
}

}  // namespace raylab
