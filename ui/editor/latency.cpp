#include "ui/editor/latency.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "engine/core/file.h"

namespace raylab {

double LatencyRecorder::quantile(double quantile) const {
    if (seconds_.empty()) return 0.0;
    std::vector<double> sorted = seconds_;
    const auto rank = static_cast<size_t>(std::ceil(quantile * static_cast<double>(sorted.size())));
    const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(std::clamp<size_t>(rank, 1, sorted.size()) - 1);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
}

void LatencyRecorder::write(const std::filesystem::path& path) const {
    const auto milliseconds = [&](double part) { return 1e3 * quantile(part); };
    const nlohmann::ordered_json json{
        {"schema", "raylab.latency/1"},
        {"frames", count()},
        {"milliseconds", {{"p50", milliseconds(0.5)}, {"p99", milliseconds(0.99)}, {"worst", milliseconds(1.0)}}}};
    const std::string text = json.dump(2) + "\n";
    writeFileAtomically(path, std::as_bytes(std::span(text)));
}

}  // namespace raylab
