#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/support/draw_bsdf.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/reference_path_tracer.h"
#include "tests/support/scene_build.h"

/// Pictures of tiny scenes against the double-precision path tracer, which has no code of the kernels and samples
/// neither lobes nor lights: what has no closed form.
namespace raylab::support {
namespace {

using Reference = GpuTest;

constexpr int kSize = 12;
constexpr int kDepth = 4;

/// Z-test of each pixel and channel, over both variances. The means of heavy tails are not normal at the end of the
/// tails, so one in a hundred may be beyond 3.5 (by chance: one in 2000) and none beyond 7; a bias of all pixels shows
/// in the mean of the picture: 4 standard errors and 1 %.
void expectSamePicture(const FilmImage& film, const std::vector<ReferencePixel>& reference, const char* what) {
    size_t far = 0;
    double worst = 0.0;
    glm::dvec3 difference(0.0), total(0.0), variance(0.0);
    for (size_t p = 0; p < reference.size(); ++p)
        for (int c = 0; c < 3; ++c) {
            const size_t at = 3 * p + static_cast<size_t>(c);
            const double mean = static_cast<double>(film.mean.pixels[at]);
            const double v = reference[p].variance[c] + static_cast<double>(film.variance.pixels[at]) /
                                                            static_cast<double>(film.samples.pixels[p]);
            const double z = v > 0.0 ? (mean - reference[p].mean[c]) / std::sqrt(v) : 0.0;
            if (v <= 0.0) {
                EXPECT_NEAR(mean, reference[p].mean[c], 1e-5) << what << ", pixel " << p;
            }
            far += std::abs(z) > 3.5 ? 1 : 0;
            worst = std::max(worst, std::abs(z));
            difference[c] += mean - reference[p].mean[c];
            total[c] += reference[p].mean[c];
            variance[c] += v;
        }
    for (int c = 0; c < 3; ++c) {
        std::printf("%s, channel %d: mean %.5f, off by %+.5f +- %.5f\n", what, c,
                    total[c] / static_cast<double>(reference.size()),
                    difference[c] / static_cast<double>(reference.size()),
                    std::sqrt(variance[c]) / static_cast<double>(reference.size()));
        EXPECT_LE(std::abs(difference[c]), 4.0 * std::sqrt(variance[c])) << what << ", channel " << c;
        EXPECT_LE(std::abs(difference[c]), 0.01 * total[c]) << what << ", channel " << c;
    }
    std::printf("%s: largest |z| %.2f, beyond 3.5: %zu of %zu\n", what, worst, far, 3 * reference.size());
    EXPECT_LE(far, 3 * reference.size() / 100) << what;
    EXPECT_LE(worst, 7.0) << what;
}

void compare(Device& device, const Scene& scene, int samples, const char* what) {
    const std::vector<ReferencePixel> reference = ReferencePathTracer(scene).render(kSize, samples, kDepth, 20240607);
    expectSamePicture(renderFilm(device, scene, smallImage(kSize, 1024, kDepth)), reference, what);
}

void addFloor(Scene& scene, const Material& material) {
    Scene floor = floorOf(material);
    Mesh mesh = floor.meshes[0];
    for (glm::vec3& p : mesh.positions) p *= 0.2f;
    mesh.material = addMaterial(scene, material);
    addMesh(scene, std::move(mesh));
}

/// An open room: brushed metal, plastic, cloth and a coated block under a lamp and a grey sky.
TEST_F(Reference, OpaqueLobes) {
    Scene scene;
    Material brushed = lambert({0.9f, 0.7f, 0.5f});
    brushed.metallic = 0.8f;
    brushed.specular = 1.0f;
    brushed.roughness = 0.6f;
    brushed.anisotropy = 0.6f;
    addFloor(scene, brushed);
    Material plastic = lambert({0.8f, 0.3f, 0.2f});
    plastic.specular = 1.0f;
    plastic.specularColor = {0.5f, 1.0f, 2.0f};
    plastic.roughness = 0.5f;
    addMesh(scene, quad(addMaterial(scene, plastic), {-2, 0, -1.5f}, {2, 0, -1.5f}, {2, 3, -1.5f}, {-2, 3, -1.5f}));
    Material cloth = lambert({0.2f, 0.3f, 0.6f});
    cloth.sheenColor = {1.0f, 0.8f, 0.6f};
    cloth.sheenRoughness = 0.6f;
    addMesh(scene, box(addMaterial(scene, cloth), {-1.2f, 0.0f, -0.8f}, {-0.2f, 0.9f, 0.2f}));
    Material coated = cloth;
    coated.clearcoat = 0.9f;
    coated.clearcoatRoughness = 0.6f;
    coated.specular = 0.7f;
    coated.roughness = 0.8f;
    addMesh(scene, box(addMaterial(scene, coated), {0.2f, 0.0f, -0.6f}, {1.1f, 0.6f, 0.3f}));
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(3.0f, true)), 0.9f, 2.6f));
    scene.environment = constantEnvironment(0.4f);
    lookAt(scene, {0.3f, 1.6f, 4.2f}, {0.0f, 0.6f, -0.3f}, 0.7f);
    compare(device_, scene, 3000, "opaque lobes");
}

/// A frosted block and a clear one, both coloured inside, on a diffuse floor.
TEST_F(Reference, GlassAndVolumes) {
    Scene scene;
    addFloor(scene, lambert({0.7f, 0.6f, 0.5f}));
    Material frosted = glass(1.4f);
    frosted.roughness = 0.6f;
    frosted.attenuationColor = {0.3f, 0.8f, 0.5f};
    frosted.attenuationDistance = 0.7f;
    addMesh(scene, box(addMaterial(scene, frosted), {-1.2f, 0.05f, -0.6f}, {-0.1f, 1.1f, 0.4f}));
    Material clear = glass(1.5f);
    clear.baseColor = {0.9f, 1.0f, 0.8f};
    clear.attenuationColor = {0.9f, 0.4f, 0.2f};
    clear.attenuationDistance = 1.0f;
    addMesh(scene, box(addMaterial(scene, clear), {0.2f, 0.05f, -0.5f}, {1.1f, 0.8f, 0.3f}));
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(4.0f, true)), 1.2f, 2.6f));
    scene.environment = constantEnvironment(0.5f);
    lookAt(scene, {0.3f, 1.6f, 4.2f}, {0.0f, 0.5f, -0.1f}, 0.6f);
    compare(device_, scene, 4000, "glass and volumes");
}

}  // namespace
}  // namespace raylab::support
