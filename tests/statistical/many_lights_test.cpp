#include <cmath>
#include <cstdio>

#include "engine/core/stopwatch.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// S20: the same flux from 1, 100 and 10,000 lights, chosen by a tree, by power and uniformly.
namespace raylab::support {
namespace {

using ManyLights = GpuTest;

constexpr double kAlbedo = 0.6;

FilmImage viewOrigin(Device& device, Scene scene, const std::string& choice, int64_t spp) {
    addMesh(scene, floorQuad(addMaterial(scene, lambert(static_cast<float>(kAlbedo))), 3.0f));
    lookAtPoint(scene, {3.0f, 0.4f, 1.0f}, glm::vec3(0.0f));
    RenderSettings settings = smallImage(16, spp, 1);
    settings.lightChoice = choice;
    return renderFilm(device, scene, settings);
}

void report(const char* what, int side, const std::string& choice, const FilmImage& film, double exact,
            double seconds) {
    const Estimate estimate = estimateOf(film);
    std::printf("%-8s %5d lights, %-8s %.6f +- %.6f, exactly %.6f  (%.2f s)\n", what, side * side, choice.c_str(),
                estimate.mean, estimate.standardError, exact, seconds);
    expectExact(film, exact, std::string(what) + " " + std::to_string(side * side) + " " + choice);
}

/// Point lights on a grid above the floor, of intensities from 1 to 5 that add up to 10.
TEST_F(ManyLights, PointLights) {
    for (const int side : {1, 10, 100}) {
        Scene scene;
        double total = 0.0, exact = 0.0;
        for (int i = 0; i < side * side; ++i) total += 1.0 + i % 5;
        for (int i = 0; i < side * side; ++i) {
            const glm::dvec3 p((i % side + 0.5) / side - 0.5, 1.0, (i / side + 0.5) / side - 0.5);
            const double intensity = 10.0 * (1.0 + i % 5) / total;
            Light light;
            light.position = p;
            light.intensity = glm::vec3(static_cast<float>(intensity));
            scene.lights.push_back(light);
            exact += kAlbedo / kPi * intensity / std::pow(glm::length(p), 3.0);
        }
        for (const std::string choice : {"tree", "power", "uniform"}) {
            const Stopwatch watch;
            const FilmImage film = viewOrigin(device_, scene, choice, 2048);
            report("point", side, choice, film, exact, watch.seconds());
        }
    }
}

/// The square lamp of A5 in square tiles.
Mesh tiles(uint32_t material, int side) {
    Mesh mesh;
    mesh.material = material;
    for (int i = 0; i < side * side; ++i) {
        const double step = 1.0 / side, x = i % side * step - 0.5, z = i / side * step - 0.5;
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)})
            mesh.positions.emplace_back(x + corner.x * step, 1.0, z + corner.y * step);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.triangles.emplace_back(first, first + 2, first + 3);
    }
    return mesh;
}

TEST_F(ManyLights, TilesOfALamp) {
    const double exact = kAlbedo / kPi * 0.752275 * 3.0;
    for (const int side : {1, 10, 100}) {
        Scene scene;
        addMesh(scene, tiles(addMaterial(scene, lamp(3.0f)), side));
        for (const std::string choice : {"tree", "power", "uniform"}) {
            const Stopwatch watch;
            const FilmImage film = viewOrigin(device_, scene, choice, 1024);
            report("tiles", side, choice, film, exact, watch.seconds());
        }
    }
}

/// One half of that lamp 80 times as bright as the other, and a point light before it: whichever way is chosen, the sum
/// is the same.
TEST_F(ManyLights, UnlikeLamps) {
    const double exact = kAlbedo / kPi * (0.752275 * 0.5 * (0.5 + 40.0) + 2.0 / 0.25);
    Scene scene;
    addMesh(scene, quad(addMaterial(scene, lamp(40.0f)), {0, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {0, 1, 0.5}));
    addMesh(scene, quad(addMaterial(scene, lamp(0.5f)), {-0.5, 1, -0.5}, {0, 1, -0.5}, {0, 1, 0.5}, {-0.5, 1, 0.5}));
    Light light;
    light.position = {0.0f, 0.5f, 0.0f};
    light.intensity = glm::vec3(2.0f);
    scene.lights = {light};
    for (const std::string choice : {"tree", "power", "uniform"}) {
        const Stopwatch watch;
        const FilmImage film = viewOrigin(device_, scene, choice, 8192);
        report("unlike", 1, choice, film, exact, watch.seconds());
    }
}

}  // namespace
}  // namespace raylab::support
