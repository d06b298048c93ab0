#include "tests/support/trace_choice.h"

#include "engine/accel/layout.h"
#include "engine/render/tracer.h"
#include "engine/render/triangle_record.h"

namespace raylab::support {

std::vector<RenderSettings> everyLayout() {
    std::vector<RenderSettings> choices;
    for (const LayoutInfo& layout : layouts()) {
        choices.emplace_back();
        choices.back().layout = layout.name;
    }
    return choices;
}

std::vector<RenderSettings> everyLayoutAndTest() {
    std::vector<RenderSettings> choices;
    for (RenderSettings settings : everyLayout())
        for (const TriangleTestInfo& test : triangleTests()) {
            settings.triangle = test.name;
            choices.push_back(settings);
        }
    return choices;
}

std::string nameOf(const RenderSettings& settings) {
    return (settings.tracer == "software" ? "" : settings.tracer + " ") + settings.builder + " " + settings.layout + " " + settings.triangle + " leaf " +
           std::to_string(settings.leafSize) + (settings.flattenLimit == 0 ? " two-level" : "") +
           (settings.trees == "merged" ? "" : " mesh");
}

RenderSettings twoLevels(RenderSettings settings) {
    settings.flattenLimit = 0;
    return settings;
}

std::vector<RenderSettings> everyTracer(const DeviceDescription& device) {
    std::vector<RenderSettings> choices;
    for (const std::string& tracer : tracerNames())
        for (const char* trees : {"merged", "mesh"}) {
            if (!missingForTracer(tracer, device).empty()) continue;
            choices.emplace_back();
            choices.back().tracer = tracer;
            choices.back().trees = trees;
        }
    return choices;
}

std::vector<RenderSettings> hardwareTracers(const DeviceDescription& device) {
    std::vector<RenderSettings> choices = everyTracer(device);
    std::erase_if(choices, [](const RenderSettings& s) { return !makeTracer(s.tracer)->info().driverStructures; });
    return choices;
}

std::string missingByDefault(const std::string& tracer) {
    static const DeviceDescription description = Device(DeviceOptions{}).description();
    return missingForTracer(tracer, description);
}

RenderSettings bruteForce(RenderSettings settings) {
    settings.tracer = "brute";
    return settings;
}

}  // namespace raylab::support
