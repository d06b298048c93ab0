#include <algorithm>
#include <cmath>

#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// Motion blur of the camera.
namespace raylab::support {
namespace {

using MotionBlur = GpuTest;

/// A camera looks down at a white half plane, x > 0, and moves along x. A point of the image is white for the share of
/// time that the edge is behind it: a linear ramp as wide as the motion.
TEST_F(MotionBlur, AnEdgeBecomesARamp) {
    constexpr double kHeight = 2.0, kWay = 0.4;
    constexpr int kSize = 32;
    for (const double shutter : {1.0, 0.5}) {
        Scene scene;
        addMesh(scene, quad(addMaterial(scene, lamp(1.0f)), {0, 0, 3}, {3, 0, 3}, {3, 0, -3}, {0, 0, -3}));
        lookDown(scene, static_cast<float>(kHeight));
        Camera end = scene.cameras[0];
        end.name = "end";
        end.position.x = end.target.x = static_cast<float>(kWay);
        scene.cameras.push_back(end);
        RenderSettings settings = smallImage(kSize, 256, 1);
        settings.antialias = "1";
        settings.cameraEnd = "end";
        settings.shutter = shutter;
        const FilmImage film = renderFilm(device_, scene, settings);
        for (int x = 0; x < kSize; ++x) {
            const double place = (x + 0.5) / kSize - 0.5;  // on the plane, seen from where the motion starts
            const double exact = std::clamp((place + kWay * shutter) / (kWay * shutter), 0.0, 1.0);
            for (int y = 0; y < kSize; y += 5)
                EXPECT_NEAR(static_cast<double>(film.mean.at(x, y)[0]), exact, 2.0 / 256.0)
                    << "column " << x << ", shutter " << shutter;
        }
    }
}

/// Where the camera ends as it started, nothing changes but the numbers' rounding.
TEST_F(MotionBlur, StandingStillIsSharp) {
    Scene scene;
    addMesh(scene, quad(addMaterial(scene, lamp(1.0f)), {0, 0, 3}, {3, 0, 3}, {3, 0, -3}, {0, 0, -3}));
    lookDown(scene, 2.0f);
    RenderSettings settings = smallImage(16, 4, 1);
    const FilmImage still = renderFilm(device_, scene, settings);
    settings.cameraEnd = "0";
    EXPECT_EQ(countDifferent(renderFilm(device_, scene, settings).mean, still.mean, 1e-6f), 0u);
}

}  // namespace
}  // namespace raylab::support
