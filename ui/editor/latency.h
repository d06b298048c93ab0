#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace raylab {

/// What passes from an input event to the frame that shows what it did, in seconds.
struct FrameTimes {
    double waiting = 0.0;   ///< for the frame before to end
    double building = 0.0;  ///< what the frame shows
    double drawing = 0.0;   ///< until the device has drawn it and it has been handed to the display

    double total() const { return waiting + building + drawing; }
};

/// Times from an input event to the frame that shows what it did, as seen by the process.
class LatencyRecorder {
public:
    void record(const FrameTimes& times) { times_.push_back(times); }
    /// A frame was shown, with or without an event.
    void countFrame() { ++drawn_; }
    void clear() { *this = {}; }
    /// The smallest time that the part `quantile` of all times does not exceed; 0 without any.
    double quantile(double quantile) const;
    /// {"schema": "raylab.latency/1", "frames": that answered an event, "drawn": all, "milliseconds": {"p50": , "p99":
    /// , "worst": }, "parts": {"waiting": {the same}, "building": , "drawing": }}. Throws Error where it cannot be
    /// written.
    void write(const std::filesystem::path& path) const;

private:
    std::vector<FrameTimes> times_;
    size_t drawn_ = 0;
};

}  // namespace raylab
