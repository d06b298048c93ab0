#include "assets/generate/statue.h"

#include <tbb/parallel_invoke.h>

#include "assets/generate/isosurface.h"
#include "assets/generate/statue_parts.h"

namespace raylab::assets {

Geometry makeStatue() {
    constexpr float kScale = 1.3f;  // half as large again as life
    constexpr float kCell = 0.0060f;
    Geometry body;
    Geometry left;
    Geometry right;
    const Figure figure;
    const IsosurfaceConfig config{.low = {-0.62f, kGround - 0.02f, -1.02f},
                                  .high = {0.62f, 2.02f, 0.46f},
                                  .cell = kCell,
                                  .lipschitz = kFigureLipschitz};
    tbb::parallel_invoke([&] { body = polygonise(config, [&](glm::vec3 p) { return figure.distance(p); }); },
                         [&] { left = wing(1.0f); }, [&] { right = wing(-1.0f); });
    Geometry statue;
    const glm::mat4 pose = place({0.0f, -kScale * kGround, 0.0f}, 0.0f, glm::vec3(kScale));
    for (const Geometry* part : {&body, &left, &right}) append(statue, *part, pose);
    // The veins run obliquely through the block.
    projectUvs(statue, glm::normalize(glm::vec3(0.75f, 0.35f, -0.55f)),
               glm::normalize(glm::vec3(0.30f, -0.88f, -0.15f)));
    return statue;
}

}  // namespace raylab::assets
