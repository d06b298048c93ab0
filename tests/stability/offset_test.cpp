#include <cstdio>

#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// S5: how far a ray's origin is moved off the surface that it leaves, which must not be through what is close behind.
/// S4, the way back through the surface itself: tests/unit/gpu_robust_test.cpp.
namespace raylab::support {
namespace {

using Offset = GpuTest;

/// Hits within rounding of a side wall may be placed behind it: measured on lavapipe, 11 pixels of 1024 see the sky in
/// one of their 1000 rays. Twice that is the bound.
constexpr size_t kKnownLitPixels = 22;

/// No light comes into a closed box, however low it is, until its height is a few units in the last place.
TEST_F(Offset, NoLightInALowBox) {
    for (const auto& [gap, at] : {std::pair(1e-4f, 1.0f), std::pair(1e-3f, 1.0f), std::pair(1e-3f, 1e3f)}) {
        Scene scene;
        const glm::vec3 lo(at), hi = lo + glm::vec3(1.0f, gap, 1.0f);
        addMesh(scene, box(addMaterial(scene, lambert(1.0f)), lo, hi));
        scene.environment = constantEnvironment(1.0f);
        const glm::vec3 eye(at + 0.5f, at + 0.5f * (hi.y - lo.y), at + 0.5f);
        lookAt(scene, eye, eye + glm::vec3(1.0f, -0.2f, 0.3f), 1.0f);
        RenderSettings settings = smallImage(32, 128, 8);
        settings.rouletteDepth = 8;
        const FilmImage film = renderFilm(device_, scene, settings);
        size_t lit = 0;
        for (size_t i = 0; i < film.mean.pixels.size(); i += 3) lit += film.mean.pixels[i] != 0.0f ? 1u : 0u;
        std::printf("height %g at %g: %zu pixels lit\n", static_cast<double>(gap), static_cast<double>(at), lit);
        EXPECT_LE(lit, kKnownLitPixels) << "pixels, height " << gap << " at " << at;
        EXPECT_GT(film.rays, 1'000'000u);
    }
}

}  // namespace
}  // namespace raylab::support
