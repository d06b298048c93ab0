#include "engine/render/kernel_use.h"

#include <algorithm>
#include <vector>

#include "engine/accel/layout.h"

namespace raylab {
namespace {

constexpr std::string_view kCompute = ".comp";

/// The traversal that a compute kernel's name ends with; empty where it is of none alone.
std::string traversalIn(std::string_view entry) {
    std::vector<std::string> traversals = layoutNames();
    for (const std::string& tracer : tracerNames()) traversals.push_back(tracer);
    const auto found = std::ranges::find_if(
        traversals, [entry](const std::string& name) { return entry.ends_with("_" + name + std::string(kCompute)); });
    return found == traversals.end() ? "" : *found;
}

}  // namespace

std::string traversalOf(const PreparedScene& prepared) {
    return prepared.traceConfig.layout.empty() ? std::string(prepared.tracer->info().name)
                                               : prepared.traceConfig.layout;
}

bool mayServe(std::string_view entry, std::string_view traversal) {
    if (!entry.ends_with(kCompute)) return traversal == "pipeline";
    const std::string own = traversalIn(entry);
    return own.empty() || own == traversal;
}

}  // namespace raylab
