#include "ui/editor/latency.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>

#include "engine/core/file.h"

namespace raylab {

namespace {

/// The smallest time that the part `quantile` of all times does not exceed; 0 without any.
double quantileOf(std::vector<double> seconds, double quantile) {
    if (seconds.empty()) return 0.0;
    const auto rank = static_cast<size_t>(std::ceil(quantile * static_cast<double>(seconds.size())));
    const auto at = seconds.begin() + static_cast<std::ptrdiff_t>(std::clamp<size_t>(rank, 1, seconds.size()) - 1);
    std::nth_element(seconds.begin(), at, seconds.end());
    return *at;
}

/// `part`: a member of FrameTimes.
template <class Part>
std::vector<double> secondsOf(const std::vector<FrameTimes>& times, const Part& part) {
    std::vector<double> seconds;
    seconds.reserve(times.size());
    for (const FrameTimes& each : times) seconds.push_back(std::invoke(part, each));
    return seconds;
}

nlohmann::ordered_json quantilesOf(const std::vector<double>& seconds) {
    nlohmann::ordered_json json;
    json["p50"] = 1e3 * quantileOf(seconds, 0.5);
    json["p99"] = 1e3 * quantileOf(seconds, 0.99);
    json["worst"] = 1e3 * quantileOf(seconds, 1.0);
    return json;
}

}  // namespace

double LatencyRecorder::quantile(double quantile) const {
    return quantileOf(secondsOf(times_, &FrameTimes::total), quantile);
}

void LatencyRecorder::write(const std::filesystem::path& path) const {
    nlohmann::ordered_json json{{"schema", "raylab.latency/1"}, {"frames", times_.size()}, {"drawn", drawn_}};
    json["milliseconds"] = quantilesOf(secondsOf(times_, &FrameTimes::total));
    json["parts"]["waiting"] = quantilesOf(secondsOf(times_, &FrameTimes::waiting));
    json["parts"]["building"] = quantilesOf(secondsOf(times_, &FrameTimes::building));
    json["parts"]["drawing"] = quantilesOf(secondsOf(times_, &FrameTimes::drawing));
    const std::string text = json.dump(2) + "\n";
    writeFileAtomically(path, std::as_bytes(std::span(text)));
}

}  // namespace raylab
