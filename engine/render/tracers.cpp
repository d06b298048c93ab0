#include <array>

#include "engine/core/error.h"
#include "engine/render/tracer_hardware.h"
#include "engine/render/tracer_software.h"

namespace raylab {
namespace {

struct TracerEntry {
    TracerInfo info;
    std::unique_ptr<Tracer> (*make)(const TracerInfo& info);
    std::string (*missing)(const RayTracingOffer& offer);
};

template <class T>
std::unique_ptr<Tracer> make(const TracerInfo& info) {
    return std::make_unique<T>(info);
}

std::string nothingMissing(const RayTracingOffer& /*offer*/) { return {}; }
std::string missingForQuery(const RayTracingOffer& offer) { return offer.queryMissing; }
std::string missingForPipeline(const RayTracingOffer& offer) { return offer.pipelineMissing; }

constexpr std::array kTracers = {
    TracerEntry{{"software", "BVH in the compute shader"}, make<SoftwareTracer>, nothingMissing},
    TracerEntry{{"brute", "every triangle, no BVH"}, make<BruteTracer>, nothingMissing},
    TracerEntry{{"query", "the driver's structures, by ray query in the compute shader", true}, make<QueryTracer>, missingForQuery},
    TracerEntry{{"pipeline", "the driver's structures, by a ray tracing pipeline", true}, make<PipelineTracer>,
                missingForPipeline},
};

const TracerEntry& findTracer(std::string_view name) {
    for (const TracerEntry& entry : kTracers)
        if (entry.info.name == name) return entry;
    throw Error("there is no tracer '" + std::string(name) + "'");
}

}  // namespace

std::vector<std::string> tracerNames() {
    std::vector<std::string> names;
    for (const TracerEntry& entry : kTracers) names.emplace_back(entry.info.name);
    return names;
}

std::string missingForTracer(std::string_view name, const DeviceDescription& device) {
    return findTracer(name).missing(device.rayTracing);
}

std::unique_ptr<Tracer> makeTracer(std::string_view name) {
    const TracerEntry& entry = findTracer(name);
    return entry.make(entry.info);
}

}  // namespace raylab
