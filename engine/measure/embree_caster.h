#pragma once

#include <memory>

#include "engine/render/hit_source.h"
#include "engine/scene/scene.h"

namespace raylab {

/// Answers by Embree (Wald et al., SIGGRAPH 2014), single rays on as many threads as TBB has, with ids as raylab's
/// tracers give them and alpha by the rule that they follow. `robust`: with its flag for watertight tests. `scene` must
/// outlive it. Throws Error where the scene holds quadrics, and where raylab was built without Embree.
std::unique_ptr<HitSource> makeEmbreeCaster(const Scene& scene, bool robust);

/// Whether raylab was built with Embree.
bool hasEmbree();

}  // namespace raylab
