#include "tests/support/trace_choice.h"

#include "engine/accel/layout.h"
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
    return settings.builder + " " + settings.layout + " " + settings.triangle + " leaf " +
           std::to_string(settings.leafSize) + (settings.flattenLimit == 0 ? " two-level" : "");
}

RenderSettings twoLevels(RenderSettings settings) {
    settings.flattenLimit = 0;
    return settings;
}

RenderSettings bruteForce(RenderSettings settings) {
    settings.tracer = "brute";
    return settings;
}

}  // namespace raylab::support
