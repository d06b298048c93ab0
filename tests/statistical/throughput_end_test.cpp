#include <cstdio>

#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// `--throughput-end`: Russian roulette of paths that carry little, at any bounce.
namespace raylab::support {
namespace {

using ThroughputEnd = GpuTest;

/// A2: a closed box whose walls emit 1 and reflect rho. After n events the light is rho^n: most paths fall below the
/// threshold, and the sum stays the geometric series. Under both schedules, with the depth's own roulette far away.
TEST_F(ThroughputEnd, EndsPathsWithoutBias) {
    const glm::dvec3 rho(0.25, 0.5, 0.75);
    constexpr int kDepth = 14;
    Scene scene;
    Material wall = lambert(glm::vec3(rho));
    wall.emission = glm::vec3(1.0f);
    wall.doubleSided = true;
    addMesh(scene, box(addMaterial(scene, wall), {-1.0f, -1.5f, -2.0f}, glm::vec3(1.0f)));
    lookAt(scene, {0.2f, 0.1f, 0.3f}, {-1.0f, -0.5f, -2.0f}, 1.2f);
    RenderSettings settings = smallImage(16, 512, kDepth);
    settings.rouletteDepth = 1000;
    const uint64_t rays = renderFilm(device_, scene, settings).rays;
    const glm::dvec3 exact = (1.0 - glm::pow(rho, glm::dvec3(kDepth + 1))) / (1.0 - rho);
    for (const double end : {0.9, 0.4})
        for (const char* const schedule : {"mega", "wavefront"}) {
            settings.throughputEnd = end;
            settings.schedule = schedule;
            const FilmImage film = renderFilm(device_, scene, settings);
            const std::string what = std::string(schedule) + ", " + std::to_string(end);
            std::printf("%s: %.3f of the rays\n", what.c_str(),
                        static_cast<double>(film.rays) / static_cast<double>(rays));
            expectExact(film, exact, what);
            EXPECT_LT(static_cast<double>(film.rays), 0.75 * static_cast<double>(rays)) << what;
        }
}

}  // namespace
}  // namespace raylab::support
