#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "engine/scene/scene.h"

namespace raylab::support {

/// Mean of a pixel's samples and the variance of that mean.
struct ReferencePixel {
    glm::dvec3 mean{0.0};
    glm::dvec3 variance{0.0};
};

/// A path tracer to judge others by: double precision, every triangle tried, directions by the cosine or evenly (what rough
/// glass refracts: by normals about the surface's own) and never by a lobe, no light sampled. Written from the papers, with
/// nothing of the kernels. For tiny scenes of flat triangles under a lamp or a constant environment. Of materials it knows no
/// textures and no priorities; opaque lobes must be rough (.3 and more), for it cannot find a mirror's direction; glass may
/// be smooth.
class ReferencePathTracer {
public:
    explicit ReferencePathTracer(const Scene& scene);
    ~ReferencePathTracer();

    /// size x size pixels through the scene's camera, row by row; box filter; at most `depth` scattering events.
    std::vector<ReferencePixel> render(int size, int samples, int depth, uint32_t seed) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace raylab::support
