#include "engine/measure/stability/evidence.h"

#include <algorithm>

namespace raylab::stability {

Evidence imageEvidence(const Scene& scene, const RenderSettings& settings) {
    return {std::make_shared<const Scene>(scene), settings, {}, {}};
}

Evidence rayEvidence(const Scene& scene, const RenderSettings& settings, std::span<const shared::RayData> rays,
                     std::span<const size_t> wrong) {
    Evidence evidence = imageEvidence(scene, settings);
    evidence.settings.integrator = "normal";
    evidence.settings.spp = 4;
    for (const size_t i : wrong.subspan(0, std::min(wrong.size(), kMostEvidence))) evidence.rays.push_back(rays[i]);
    return evidence;
}

}  // namespace raylab::stability
