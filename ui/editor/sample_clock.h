#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/measure/statistics.h"

namespace raylab {

/// What a sample of every pixel costs, from looks at a rendering as it goes on.
class SampleClock {
public:
    /// Samples that every pixel has after so many seconds of rendering; fewer than at the look before are a new
    /// rendering. `counts`: the time since the look before is that of samples alone.
    void look(uint32_t samples, double seconds, bool counts);
    /// Seconds a sample, with Student's interval over the stretches between looks; nothing before there are two.
    std::optional<Interval> perSample() const;

private:
    uint32_t samples_ = 0;
    double seconds_ = 0.0;
    bool whole_ = false;  ///< the stretch since `samples_` counts
    std::vector<double> stretches_;
};

}  // namespace raylab
