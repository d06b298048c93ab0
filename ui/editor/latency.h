#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace raylab {

/// Times from an input event to the frame that shows what it did, as seen by the process: until the device has drawn
/// the frame and it has been handed to the display.
class LatencyRecorder {
public:
    void record(double seconds) { seconds_.push_back(seconds); }
    void clear() { seconds_.clear(); }
    size_t count() const { return seconds_.size(); }
    /// The smallest time that the part `quantile` of all times does not exceed; 0 without any.
    double quantile(double quantile) const;
    /// {"schema": "raylab.latency/1", "frames": , "milliseconds": {"p50": , "p99": , "worst": }}. Throws Error where it
    /// cannot be written.
    void write(const std::filesystem::path& path) const;

private:
    std::vector<double> seconds_;
};

}  // namespace raylab
