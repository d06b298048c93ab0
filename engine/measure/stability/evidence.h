#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/render/render_settings.h"
#include "engine/scene/scene.h"
#include "shaders/shared/frame.h"

namespace raylab::stability {

/// What there is to see of a number: a scene with its first camera, and what of it is wrong.
struct Evidence {
    std::shared_ptr<const Scene> scene;
    RenderSettings settings;
    std::vector<shared::RayData> rays;  ///< wrong ones, kMostEvidence at most
    std::vector<glm::dvec2> pixels;     ///< middles of wrong ones, (0,0) to (1,1) from the image's upper left corner
};

constexpr size_t kMostEvidence = 2000;

/// An image of a scene.
Evidence imageEvidence(const Scene& scene, const RenderSettings& settings);

/// Rays at the places `wrong` of `rays`, in a scene that is seen as a whole, by its normals.
Evidence rayEvidence(const Scene& scene, const RenderSettings& settings, std::span<const shared::RayData> rays,
                     std::span<const size_t> wrong);

}  // namespace raylab::stability
