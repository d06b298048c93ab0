#include "ui/editor/moving_size.h"

namespace raylab {
namespace {

/// A moving picture may take so long; at the largest divisor it may take longer.
constexpr double kMovingSeconds = 0.06;
constexpr uint32_t kLargestDivisor = 8;

}  // namespace

void MovingSize::beginUnknown() {
    preview_ = true;
    secondsPerPixel_ = kUnknownCost;
}

void MovingSize::measure(const Renderer& renderer) {
    if (renderer.pixelSamples() > 0)
        secondsPerPixel_ = renderer.times().render / static_cast<double>(renderer.pixelSamples());
}

uint32_t MovingSize::divisorFor(const RenderRequest& request) const {
    if (preview_) return kLargestDivisor;
    if (!request.moving) return 1;
    const double full = secondsPerPixel_ * request.width * request.height;
    for (uint32_t divisor = 1; divisor < kLargestDivisor; divisor *= 2)
        if (full / (divisor * divisor) <= kMovingSeconds) return divisor;
    return kLargestDivisor;
}

}  // namespace raylab
