#pragma once

#include <cstdint>

#include "engine/render/renderer.h"
#include "ui/editor/render_request.h"

namespace raylab {

/// How much smaller the picture of a moving view is than the viewport, by what a sample of a pixel was measured to
/// take.
class MovingSize {
public:
    /// Nothing is known of what comes: a small picture comes first.
    void beginUnknown();
    /// The small picture that came first is done.
    void endPreview() { preview_ = false; }
    bool isPreview() const { return preview_; }
    void measure(const Renderer& renderer);

    /// What width and height are divided by: 1, 2, 4 or 8.
    uint32_t divisorFor(const RenderRequest& request) const;

private:
    static constexpr double kUnknownCost = 1e-6;  ///< seconds a pixel: a guess that leads to small pictures at first

    double secondsPerPixel_ = kUnknownCost;
    bool preview_ = false;
};

}  // namespace raylab
