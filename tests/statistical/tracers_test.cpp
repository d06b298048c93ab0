#include <cstdio>

#include "engine/measure/image_error.h"
#include "engine/render/tracer.h"
#include "engine/scene/import.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/paths.h"

namespace raylab::support {
namespace {

using Tracers = GpuTest;

FilmImage render(Device& device, const Scene& scene, const std::string& tracer, int64_t seed,
                 int64_t spp = 256) {
    RenderSettings settings = smallImage(32, spp, 6);
    settings.tracer = tracer;
    settings.trees = "merged";  // the same space, hence nearly the same numbers, on all tracers
    settings.seed = seed;
    return renderFilm(device, scene, settings);
}

Bitmap varianceOfMean(const FilmImage& film) {
    Bitmap variance = film.variance;
    for (size_t i = 0; i < variance.pixels.size(); ++i) variance.pixels[i] /= film.samples.pixels[i / 3];
    return variance;
}

std::vector<std::string> tracersOf(const Device& device) {
    std::vector<std::string> names;
    for (const std::string& name : tracerNames())
        if (missingForTracer(name, device.description()).empty()) names.push_back(name);
    return names;
}

struct NamedScene {
    const char* name;
    Scene scene;
};

/// Triangles; instances, alpha and textures; spheres and other quadrics, of glass, mirror and plaster.
std::vector<NamedScene> scenes() {
    const std::filesystem::path assets = binaryFolder() / "assets";
    std::vector<NamedScene> scenes;
    for (const char* name : {"cornell", "courtyard", "quadrics"})
        scenes.push_back({name, importScene(assets / (std::string(name) + ".glb"))});
    return scenes;
}

/// With one seed all follow the same paths: pixels that differ show differing hits. Brute force is left to the small
/// scene.
TEST_F(Tracers, SameSeedSamePicture) {
    for (const NamedScene& named : scenes()) {
        const FilmImage software = render(device_, named.scene, "software", 1, 8);
        for (const std::string& tracer : tracersOf(device_)) {
            if (tracer == "software" || (tracer == "brute" && std::string(named.name) == "courtyard")) continue;
            const FilmImage other = render(device_, named.scene, tracer, 1, 8);
            const size_t different = countDifferent(software.mean, other.mean, 1e-3f);
            std::printf("%-10s %-10s %zu of %zu values differ by more than 1e-3\n", named.name, tracer.c_str(), different,
                        software.mean.pixels.size());
            EXPECT_LE(different, software.mean.pixels.size() / 50) << named.name << " " << tracer;
        }
    }
}

TEST_F(Tracers, SoftwareEqualsBruteForceWithTheSameSeed) {
    const Scene scene = scenes().front().scene;
    const FilmImage software = render(device_, scene, "software", 1), brute = render(device_, scene, "brute", 1);
    EXPECT_LE(countDifferent(software.mean, brute.mean, 1e-5f), software.mean.pixels.size() / 1000);
    EXPECT_EQ(software.rays, brute.rays);
}

/// A17's test on two estimates of our own: 99.75 % of the pixels at a significance of 0.01, Sidak-corrected. It is
/// also a test of the film's variance: were it too small, the pixels of two seeds would differ too much.
TEST_F(Tracers, DifferentSeedsAgreeWithinTheirNoise) {
    for (const NamedScene& named : scenes()) {
        const FilmImage software = render(device_, named.scene, "software", 2);
        for (const std::string& tracer : tracersOf(device_)) {
            if (tracer == "software" || (tracer == "brute" && std::string(named.name) == "courtyard")) continue;
            const FilmImage other = render(device_, named.scene, tracer, 3);
            const ZTest test = zTest(software.mean, varianceOfMean(software), other.mean, varianceOfMean(other));
            EXPECT_EQ(test.pixels, 1024u);
            EXPECT_GE(test.passFraction, 0.9975) << named.name << " " << tracer;
            EXPECT_NE(software.mean.pixels, other.mean.pixels) << named.name << " " << tracer;
        }
    }
}

}  // namespace
}  // namespace raylab::support
