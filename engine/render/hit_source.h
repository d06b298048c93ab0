#pragma once

#include <span>
#include <vector>

#include "shaders/shared/frame.h"

namespace raylab {

/// Whoever answers for lists of rays.
class HitSource {
public:
    virtual ~HitSource() = default;
    /// Closest hits; t is negative where there is none. A ray's index in the list is the key of its blended alpha, in
    /// lists of up to 65,536.
    virtual std::vector<shared::HitData> closest(std::span<const shared::RayData> rays) = 0;
    /// t is 1 where something lies between tMin and tMax, negative where not.
    virtual std::vector<shared::HitData> occluded(std::span<const shared::RayData> rays) = 0;
    /// Seconds that tracing took in the last call, without upload and download.
    virtual double traceSeconds() const = 0;
};

}  // namespace raylab
