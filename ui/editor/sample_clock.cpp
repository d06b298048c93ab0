#include "ui/editor/sample_clock.h"

namespace raylab {
namespace {

constexpr size_t kMostStretches = 1000;

}  // namespace

void SampleClock::look(uint32_t samples, double seconds, bool counts) {
    if (samples < samples_ || seconds < seconds_) stretches_.clear();
    const bool isNew = samples < samples_ || seconds < seconds_;
    whole_ = whole_ && counts && !isNew;
    if (!isNew && samples == samples_) return;
    if (whole_ && stretches_.size() < kMostStretches) stretches_.push_back((seconds - seconds_) / (samples - samples_));
    samples_ = samples;
    seconds_ = seconds;
    whole_ = samples > 0;  // the first sample is measured by small dispatches
}

std::optional<Interval> SampleClock::perSample() const {
    if (stretches_.size() < 2) return std::nullopt;
    return meanInterval(stretches_);
}

}  // namespace raylab
