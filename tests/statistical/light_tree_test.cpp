#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>

#include "engine/gpu/buffer.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/gpu_data.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/frame.h"
#include "tests/shaders/routines.h"
#include "tests/support/chi_squared.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/paths.h"
#include "tests/support/scene_build.h"

/// The tree over lights: what it chooses against what it says that it chooses, and against the other ways to choose.
namespace raylab::support {
namespace {

using LightTreeChoice = GpuTest;

constexpr uint32_t kSeed = 20240611;
constexpr BindingInfo kFrame{shared::kBindFrame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};
constexpr BindingInfo kResult{shared::kBindHits, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
constexpr BindingInfo kNodes{shared::kBindLightNodes, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER};
constexpr BindingInfo kTrails{shared::kBindLightTrails, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER};

glm::vec3 randomIn(std::mt19937& random, float half) {
    std::uniform_real_distribution<float> number(-half, half);
    const float x = number(random), y = number(random);
    return {x, y, number(random)};
}

Light randomLight(std::mt19937& random, int i) {
    Light light;
    light.kind = std::array{LightKind::point, LightKind::spot, LightKind::sphere, LightKind::disc,
                            LightKind::rectangle}[static_cast<size_t>(i % 5)];
    light.position = randomIn(random, 2.0f);
    light.direction = glm::normalize(randomIn(random, 1.0f));
    light.tangent = glm::normalize(glm::cross(light.direction, glm::vec3(0.3f, 0.5f, 0.8f)));
    light.intensity = glm::vec3(std::exp2(randomIn(random, 3.0f).x));
    light.outerConeRadians = 0.6f;
    light.radius = 0.1f;
    light.size = {0.2f, 0.1f};
    return light;
}

/// Lamps of one and of two sides, and lights of each kind.
Scene manyLights(int count) {
    std::mt19937 random(kSeed);
    Scene scene;
    Mesh mesh[2];
    for (int side = 0; side < 2; ++side) mesh[side].material = addMaterial(scene, lamp(3.0f, side == 1));
    for (int i = 0; i < count; ++i) {
        Mesh& into = mesh[i % 2];
        const glm::vec3 p = randomIn(random, 2.0f);
        const auto first = static_cast<uint32_t>(into.positions.size());
        into.triangles.emplace_back(first, first + 1, first + 2);
        for (const glm::vec3 corner : {p, p + randomIn(random, 0.2f), p + randomIn(random, 0.2f)})
            into.positions.push_back(corner);
        scene.lights.push_back(randomLight(random, i));
    }
    for (Mesh& m : mesh) addMesh(scene, m);
    return scene;
}

/// Trails of all lights, found by walking the nodes.
std::vector<LightTrail> trailsOf(const LightTables& lights, size_t lightCount) {
    std::vector<LightTrail> trails(lightCount);
    struct Pending {
        uint32_t pair, trail, depth;
    };
    std::vector<Pending> pending = {{0, 0, 0}};
    size_t leaves = 0;
    while (!pending.empty()) {
        const Pending at = pending.back();
        pending.pop_back();
        for (uint32_t side = 0; side < 2; ++side) {
            const shared::LightNodeData& node = lights.nodes[2 * at.pair + side];
            const uint32_t trail = at.trail | side << at.depth;
            if ((node.flags & shared::kLightNodeLeaf) == 0) {
                pending.push_back({node.reference, trail, at.depth + 1});
                continue;
            }
            trails[node.reference].trail = trail | 2u << at.depth;
            ++leaves;
        }
    }
    EXPECT_EQ(leaves, lightCount);
    return trails;
}

/// Runs tests/shaders/light_choice.comp.
class Chooser {
public:
    Chooser(Device& device, const LightTables& lights, std::span<const LightTrail> trails) : device_(device) {
        shared::FrameParams frame{};
        frame.lightGridOrigin = lights.gridOrigin;
        frame.lightGridStep = lights.gridStep;
        frame_ =
            makeDeviceBuffer(device, "frame", std::as_bytes(std::span(&frame, 1)), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
        nodes_ =
            makeTexelBuffer(device, "nodes", std::as_bytes(std::span(lights.nodes)), VK_FORMAT_R32G32B32A32_UINT, 16);
        trails_ = makeTexelBuffer(device, "trails", std::as_bytes(trails), VK_FORMAT_R32G32_UINT, 8);
    }

    /// Light and probability of each invocation.
    std::vector<std::pair<uint32_t, float>> run(uint32_t routine, const shared::LightChoicePush& push) {
        std::vector<glm::uvec2> words(push.count);
        const Buffer result(device_, "choices", std::as_bytes(std::span(words)).size(),
                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::device);
        const BindingInfo bindings[] = {kFrame, kResult, kNodes, kTrails};
        const KernelLayout layout(device_, bindings, sizeof(push));
        bindBuffer(device_, layout, kFrame, frame_.get(), 0, frame_.sizeBytes());
        bindBuffer(device_, layout, kResult, result.get(), 0, result.sizeBytes());
        bindTexelView(device_, layout, kNodes.binding, nodes_.view.get());
        bindTexelView(device_, layout, kTrails.binding, trails_.view.get());
        const SpecConstant constants[] = {{shared::kSpecRoutine, routine}};
        const Kernel kernel =
            makeComputeKernel(device_, layout, binaryFolder() / "tests/light_choice.comp.spv", constants);
        const uint32_t groups = (push.count + shared::kWorkgroupSize - 1) / shared::kWorkgroupSize;
        device_.run("choose",
                    [&](VkCommandBuffer commands) { launch(device_, commands, layout, kernel, {}, &push, groups); });
        download(device_, result, std::as_writable_bytes(std::span(words)));
        std::vector<std::pair<uint32_t, float>> choices;
        for (const glm::uvec2 word : words) choices.emplace_back(word.x, std::bit_cast<float>(word.y));
        return choices;
    }

private:
    Device& device_;
    Buffer frame_;
    TexelBuffer nodes_, trails_;
};

/// A million choices fall as the probabilities along the trails say, none of them among lights that are said to be out
/// of reach; each choice reports the probability of its trail; and with the choices that end at nothing all add up
/// to 1.
TEST_F(LightTreeChoice, FallsAsItsProbabilities) {
    constexpr uint32_t kCount = 1u << 20;
    constexpr int kPlaces = 4;
    Scene scene = manyLights(60);
    MaterialTables materials = packMaterials(scene);
    const LightTables lights = packLights(scene, 4.0f, materials, {LightChoice::tree, false});
    const size_t lightCount = lights.emissive.size() + lights.punctual.size();
    ASSERT_EQ(lightCount, 120u);
    const std::vector<LightTrail> trails = trailsOf(lights, lightCount);
    for (size_t i = 0; i < lights.shapedCount; ++i)
        EXPECT_EQ(lights.trails[i].trail, trails[lights.emissive.size() + i].trail) << "shape " << i;
    for (size_t i = 0; i < lights.emissive.size(); ++i) {
        const shared::EmissiveData& triangle = lights.emissive[i];
        const LightTrail& found = lights.trails[lights.firstTrail[triangle.instance] + triangle.primitive];
        EXPECT_EQ(found.trail, trails[i].trail) << "triangle " << i;
    }
    Chooser chooser(device_, lights, trails);
    std::mt19937 random(kSeed + 1);
    for (int place = 0; place < kPlaces; ++place) {
        const glm::vec3 position = randomIn(random, 2.5f);
        const glm::vec3 normal = place == 0 ? glm::vec3(0.0f) : glm::normalize(randomIn(random, 1.0f));
        const auto said =
            chooser.run(shared::kRoutineLightTrail, {position, static_cast<uint32_t>(lightCount), normal, 0});
        const auto drawn = chooser.run(shared::kRoutineChooseLight, {position, kCount / kPlaces, normal, kSeed});
        std::vector<double> probabilities(lightCount + 1);
        std::vector<size_t> counts(lightCount + 1);
        double sum = 0.0;
        for (size_t i = 0; i < lightCount; ++i) sum += probabilities[i] = static_cast<double>(said[i].second);
        probabilities[lightCount] = std::max(0.0, 1.0 - sum);  // nothing
        size_t wrong = 0;
        for (const auto& [light, probability] : drawn) {
            ++counts[probability > 0.0f ? light : lightCount];
            if (probability > 0.0f && std::abs(probability - said[light].second) > 1e-4f * probability) ++wrong;
        }
        const double p = chiSquaredTest(counts, probabilities);
        std::printf("place %d: sum %.7f, nothing %.4f, chi-squared p %.3f\n", place, sum, probabilities[lightCount], p);
        EXPECT_EQ(wrong, 0u);
        EXPECT_LE(sum, 1.0 + 1e-5);
        EXPECT_GT(p, 0.01 / kPlaces) << "place " << place;
    }
}

/// Brute force: what a light sends to a point is never but for a light that the tree can choose there.
TEST_F(LightTreeChoice, ReachesEveryLightThatReachesThePoint) {
    Scene scene = manyLights(60);
    MaterialTables materials = packMaterials(scene);
    const LightTables lights = packLights(scene, 4.0f, materials, {LightChoice::tree, false});
    const size_t lightCount = lights.emissive.size() + lights.punctual.size();
    Chooser chooser(device_, lights, trailsOf(lights, lightCount));
    std::mt19937 random(kSeed + 2);
    size_t reached = 0, excluded = 0;
    for (int place = 0; place < 16; ++place) {
        const glm::vec3 position = randomIn(random, 2.5f), normal = glm::normalize(randomIn(random, 1.0f));
        const auto said =
            chooser.run(shared::kRoutineLightTrail, {position, static_cast<uint32_t>(lightCount), normal, 0});
        for (size_t i = 0; i < lights.emissive.size(); ++i) {
            const shared::EmissiveData& t = lights.emissive[i];
            const glm::dvec3 front =
                static_cast<double>(t.frontSign) * glm::cross(glm::dvec3(t.edge1), glm::dvec3(t.edge2));
            bool reaches = false;
            for (int j = 0; j < 64; ++j) {
                const double u = (j % 8 + 0.5) / 8.0, v = (j / 8 + 0.5) / 8.0;
                if (u + v > 1.0) continue;
                const glm::dvec3 toLight =
                    glm::dvec3(t.p0) + u * glm::dvec3(t.edge1) + v * glm::dvec3(t.edge2) - glm::dvec3(position);
                const double cosine = -glm::dot(front, toLight);
                const bool faces = scene.materials[t.material].doubleSided ? cosine != 0.0 : cosine > 0.0;
                reaches = reaches || (faces && glm::dot(toLight, glm::dvec3(normal)) > 0.0);
            }
            if (reaches) {
                ++reached;
                EXPECT_GT(said[i].second, 0.0f) << "triangle " << i << " at place " << place;
            }
            excluded += said[i].second == 0.0f ? 1 : 0;
        }
    }
    std::printf("%zu triangles reach a place, %zu are excluded\n", reached, excluded);
    EXPECT_GT(reached, 100u);
    EXPECT_GT(excluded, 100u);
}

/// A glossy floor below lamps: rays that hit one by scattering are weighed by the tree's probability of just that
/// triangle. Instances are mirrored and turned, and some lamps have two sides.
TEST_F(LightTreeChoice, WeighsLampsThatScatteredRaysHit) {
    Scene scene;
    Material metal = lambert(0.9f);
    metal.metallic = 1.0f;
    metal.roughness = 0.45f;
    addMesh(scene, floorQuad(addMaterial(scene, metal), 3.0f));
    for (int side = 0; side < 2; ++side) {
        const uint32_t material = addMaterial(scene, lamp(side == 0 ? 9.0f : 2.0f, side == 1));
        const float x = 0.5f * static_cast<float>(side) - 0.6f;
        const uint32_t mesh = addMesh(scene, box(material, {x, 0.3f, -0.2f}, {x + 0.2f, 0.5f, 0.1f}));
        glm::mat4 mirrored(1.0f);
        mirrored[0][0] = -1.0f;
        mirrored[3] = {0.1f, 0.4f, 0.5f, 1.0f};
        addInstance(scene, mesh, mirrored);
    }
    lookAtPoint(scene, {2.0f, 1.2f, 0.5f}, glm::vec3(0.0f));
    Estimate estimates[2];
    for (const char* choice : {"tree", "uniform"}) {
        RenderSettings settings = smallImage(16, 1024, 2);
        settings.lightChoice = choice;
        Estimate& estimate = estimates[choice[0] == 't' ? 0 : 1];
        estimate = estimateOf(renderFilm(device_, scene, settings));
        std::printf("%-8s %.5f +- %.5f\n", choice, estimate.mean, estimate.standardError);
    }
    EXPECT_LE(std::abs(estimates[0].mean - estimates[1].mean),
              4.0 * std::hypot(estimates[0].standardError, estimates[1].standardError));
    EXPECT_LE(estimates[0].standardError, 0.005 * estimates[0].mean);
}

double meanVariance(const FilmImage& film) {
    return std::accumulate(film.variance.pixels.begin(), film.variance.pixels.end(), 0.0) /
           static_cast<double>(film.variance.pixels.size());
}

/// 10,000 lights, a metre above a floor of a hundred by a hundred metres: one in two a point, the others small lamps.
Scene lampField() {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.6f)), 60.0f));
    Mesh lamps;
    lamps.material = addMaterial(scene, lamp(9.0f));
    for (int i = 0; i < 10000; ++i) {
        const glm::vec3 p(static_cast<float>(i % 100) - 49.5f, 1.0f, static_cast<float>(i / 100) - 49.5f);
        Light light;
        light.position = p;
        light.intensity = glm::vec3(0.1f);
        if (i % 2 == 0) {
            scene.lights.push_back(light);
            continue;
        }
        const auto first = static_cast<uint32_t>(lamps.positions.size());
        lamps.triangles.emplace_back(first, first + 1, first + 2);
        for (const glm::vec3 corner : {glm::vec3(0, 0, 0), glm::vec3(0.15f, 0, 0), glm::vec3(0, 0, 0.15f)})
            lamps.positions.push_back(p + corner);
    }
    addMesh(scene, lamps);
    lookAt(scene, {0.0f, 0.9f, 0.0f}, {0.0f, 0.0f, 0.0f}, 1.0f);
    scene.cameras[0].up = {0, 0, -1};
    return scene;
}

/// The same picture, and far less noise from as many samples.
TEST_F(LightTreeChoice, HasLessNoiseUnderTenThousandLights) {
    const Scene scene = lampField();
    RenderSettings settings = smallImage(16, 256, 1);
    Estimate estimates[3];
    double variance[3] = {};
    const char* const choices[] = {"tree", "power", "uniform"};
    for (size_t i = 0; i < 3; ++i) {
        settings.lightChoice = choices[i];
        const FilmImage film = renderFilm(device_, scene, settings);
        estimates[i] = estimateOf(film);
        variance[i] = meanVariance(film);
        std::printf("%-8s %.5f +- %.5f, variance of a sample %.5g\n", choices[i], estimates[i].mean,
                    estimates[i].standardError, variance[i]);
    }
    for (size_t i = 1; i < 3; ++i) {
        EXPECT_LE(std::abs(estimates[0].mean - estimates[i].mean),
                  4.0 * std::hypot(estimates[0].standardError, estimates[i].standardError))
            << choices[i];
        EXPECT_LT(variance[0], 0.05 * variance[i]) << choices[i];
    }
}

}  // namespace
}  // namespace raylab::support
