#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/accel/brute_force.h"
#include "engine/render/ray_caster.h"
#include "engine/scene/bounds.h"
#include "engine/scene/import.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// The traversal on the device against Moller and Trumbore's test in double precision over all triangles.
namespace raylab::support {
namespace {

using accel_test::Random;

/// All instances in world space, and where each triangle came from.
struct Flattened {
    accel_test::TestMesh mesh;
    std::vector<glm::uvec2> ids;  ///< instance, primitive
};

Flattened flatten(const Scene& scene) {
    Flattened flat;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto base = static_cast<uint32_t>(flat.mesh.positions.size());
        for (const glm::vec3& p : mesh.positions)
            flat.mesh.positions.emplace_back(glm::dmat4(instance.objectToWorld) * glm::dvec4(p, 1.0));
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            flat.mesh.triangles.push_back(mesh.triangles[t] + base);
            flat.ids.emplace_back(i, t);
        }
    }
    return flat;
}

/// From around and inside the scene towards points in it; lengths of the directions from 1e-2 to 1e2.
std::vector<shared::RayData> randomRays(const Scene& scene, size_t count, uint32_t seed) {
    Random random(seed);
    const Bounds bounds = sceneBounds(scene);
    const glm::vec3 centre = 0.5f * (bounds.lo + bounds.hi), extent = bounds.hi - bounds.lo;
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 origin = centre + random.inCube(-1.0f, 1.0f) * extent;
        const glm::vec3 target = centre + random.inCube(-0.5f, 0.5f) * extent;
        rays.push_back(makeRay(origin, std::pow(10.0f, random.uniform(-2.0f, 2.0f)) * glm::normalize(target - origin)));
    }
    return rays;
}

std::vector<OracleHit> oracleHits(const Flattened& flat, const std::vector<shared::RayData>& rays) {
    std::vector<OracleRay> oracleRays;
    for (const shared::RayData& ray : rays) oracleRays.push_back({ray.origin, ray.direction, ray.tMin});
    return closestHitsDouble(flat.mesh.positions, flat.mesh.triangles, oracleRays);
}

struct Agreement {
    size_t decidable = 0;
    size_t hits = 0;
    size_t wrongHits = 0;
    size_t wrongDistances = 0;
    size_t wrongShadows = 0;
};

/// What is decidable in single precision: no edge within `margin`, no second surface close by.
bool isDecidable(const OracleHit& hit, double margin) {
    return hit.margin >= margin && !(hit.hit() && hit.tNext < hit.t * 1.0001);
}

/// 1e-4 of the distance, and 8 units in the last place of coordinates as large as the scene's.
double distanceTolerance(const OracleHit& hit, const shared::RayData& ray, double largestCoordinate) {
    return 1e-4 * hit.t + 8.0 * 0x1p-24 * largestCoordinate / static_cast<double>(glm::length(ray.direction));
}

double largestCoordinateOf(const Scene& scene) {
    const Bounds bounds = sceneBounds(scene);
    const glm::vec3 largest = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
    return static_cast<double>(std::max({largest.x, largest.y, largest.z}));
}

struct Answers {
    std::vector<shared::HitData> closest, occluded;
    std::vector<shared::HitData> occludedBefore, occludedBehind;  ///< of rays that end just before and behind the hit
};

Answers askDevice(RayCaster& caster, const std::vector<shared::RayData>& rays, const std::vector<OracleHit>& expected,
                  double largestCoordinate) {
    std::vector<shared::RayData> before = rays, behind = rays;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (!expected[i].hit()) continue;
        const double margin = 4.0 * distanceTolerance(expected[i], rays[i], largestCoordinate);
        before[i].tMax = static_cast<float>(expected[i].t - margin);
        behind[i].tMax = static_cast<float>(expected[i].t + margin);
    }
    return {caster.closest(rays), caster.occluded(rays), caster.occluded(before), caster.occluded(behind)};
}

Agreement compareWithOracle(Device& device, const Scene& scene, const std::vector<shared::RayData>& rays, double margin,
                            const std::string& tracer = "software") {
    RenderSettings settings;
    settings.tracer = tracer;
    RayCaster caster(device, scene, settings);
    const Flattened flat = flatten(scene);
    const double largest = largestCoordinateOf(scene);
    const std::vector<OracleHit> expected = oracleHits(flat, rays);
    const Answers answers = askDevice(caster, rays, expected, largest);
    Agreement a;
    for (size_t i = 0; i < rays.size(); ++i) {
        const OracleHit& oracle = expected[i];
        if (!isDecidable(oracle, margin)) continue;
        ++a.decidable;
        a.hits += oracle.hit() ? 1u : 0u;
        const shared::HitData& got = answers.closest[i];
        const bool same = (got.t >= 0.0f) == oracle.hit() &&
                          (!oracle.hit() || flat.ids[oracle.primitive] == glm::uvec2(got.instance, got.primitive));
        const double error = std::abs(static_cast<double>(got.t) - oracle.t);
        a.wrongHits += same ? 0u : 1u;
        a.wrongDistances += same && oracle.hit() && error > distanceTolerance(oracle, rays[i], largest) ? 1u : 0u;
        a.wrongShadows += (answers.occluded[i].t >= 0.0f) != oracle.hit() ? 1u : 0u;
        a.wrongShadows += oracle.hit() && answers.occludedBefore[i].t >= 0.0f ? 1u : 0u;
        a.wrongShadows += oracle.hit() && answers.occludedBehind[i].t < 0.0f ? 1u : 0u;
    }
    return a;
}

void expectAgreement(const Agreement& a, size_t rays) {
    EXPECT_EQ(a.wrongHits, 0u);
    EXPECT_EQ(a.wrongDistances, 0u);
    EXPECT_EQ(a.wrongShadows, 0u);
    EXPECT_GT(a.decidable, rays * 3 / 4) << "too few rays left to mean anything";
    EXPECT_GT(a.hits, rays / 20);
}

using TraceOracle = GpuTest;

Scene soupScene(size_t count, float size) {
    Scene scene;
    addMesh(scene, meshOf(accel_test::randomSoup(count, size, 81), addMaterial(scene, lambert(0.5f))));
    return scene;
}

TEST_F(TraceOracle, RandomSoup) {
    const Scene scene = soupScene(10000, 0.05f);
    const std::vector<shared::RayData> rays = randomRays(scene, 4000, 82), few = randomRays(scene, 500, 89);
    expectAgreement(compareWithOracle(device_, scene, rays, 1e-4), rays.size());
    expectAgreement(compareWithOracle(device_, scene, few, 1e-4, "brute"), few.size());
}

/// Moved, turned, mirrored, stretched and sheared, and one mesh that is in the merged tree.
TEST_F(TraceOracle, Instances) {
    Scene scene = soupScene(300, 0.3f);
    Random random(83);
    for (int i = 0; i < 40; ++i) {
        glm::mat4 matrix = glm::translate(glm::mat4(1.0f), random.inCube(-4.0f, 4.0f));
        matrix = glm::rotate(matrix, random.uniform(0.0f, 6.0f), random.direction());
        matrix = glm::scale(matrix, random.inCube(0.2f, 2.0f) * (i % 3 == 0 ? glm::vec3(-1, 1, 1) : glm::vec3(1.0f)));
        if (i % 4 == 0) matrix[1] += 0.5f * matrix[0];
        addInstance(scene, 0, matrix);
    }
    addMesh(scene, floorQuad(0, 3.0f, -0.37f), glm::rotate(glm::mat4(1.0f), 0.2f, {1.0f, 0.0f, 0.3f}));
    const std::vector<shared::RayData> rays = randomRays(scene, 4000, 84);
    expectAgreement(compareWithOracle(device_, scene, rays, 1e-3), rays.size());
}

/// 871,414 triangles of 5e-4, whose positions carry 1e-4 of their size: a tree of its own below an instance.
TEST_F(TraceOracle, Dragon) {
    const std::optional<std::filesystem::path> path = sharedScene("stanford-dragon/dragon_vrip.ply");
    if (!path) return;
    const Scene scene = importScene(*path);
    const std::vector<shared::RayData> rays = randomRays(scene, 100, 85);
    expectAgreement(compareWithOracle(device_, scene, rays, 2e-3), rays.size());
}

/// Large walls beside small ornaments. What alpha would cut out is solid here, as the oracle knows no textures.
TEST_F(TraceOracle, Sponza) {
    const std::optional<std::filesystem::path> path = sharedScene("sponza-crytek/Sponza.gltf");
    if (!path) return;
    Scene scene = importScene(*path);
    scene.textures.clear();
    for (Material& material : scene.materials) material = lambert(0.5f);
    const std::vector<shared::RayData> rays = randomRays(scene, 400, 86);
    expectAgreement(compareWithOracle(device_, scene, rays, 1e-3), rays.size());
}

/// Cubes on an integer grid, so that origins and directions lie exactly in faces and along axes.
Scene gridOfCubes() {
    Scene scene;
    const uint32_t material = addMaterial(scene, lambert(0.5f));
    for (int i = 0; i < 64; ++i) {
        const glm::vec3 lo = 2.0f * glm::vec3(glm::ivec3(i, i >> 2, i >> 4) & 3);
        addMesh(scene, box(material, lo, lo + 1.0f));
    }
    return scene;
}

std::vector<shared::RayData> raysAlongAxes(size_t count) {
    Random random(87);
    const std::array<float, 5> tiny = {0.0f, -0.0f, 1e-42f, -1e-42f, 1e-30f};
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < count; ++i) {
        glm::vec3 origin = random.inCube(-2.0f, 9.0f);
        for (int axis = 0; axis < 3; ++axis)
            if (random.below(2) == 0) origin[axis] = static_cast<float>(random.below(9)) - 1.0f;
        const auto axis = static_cast<int>(random.below(3));
        glm::vec3 d(tiny[random.below(5)], tiny[random.below(5)], tiny[random.below(5)]);
        d[axis] = random.below(2) == 0 ? 1.0f : -1.0f;
        if (i % 5 == 0) d[(axis + 1) % 3] = random.uniform(-1.0f, 1.0f);
        rays.push_back(makeRay(origin, d, i % 2 == 0 ? 0.0f : 1e-4f));
    }
    return rays;
}

/// S7: the slab test must never cull what the triangle test would hit, 0 times infinity or not.
TEST_F(TraceOracle, RaysAlongAxesAndInFaces) {
    const Scene scene = gridOfCubes();
    const std::vector<shared::RayData> rays = raysAlongAxes(40000);
    RenderSettings settings;
    RayCaster software(device_, scene, settings);
    settings.tracer = "brute";
    RayCaster brute(device_, scene, settings);
    const std::vector<shared::HitData> a = software.closest(rays), b = brute.closest(rays);
    const std::vector<shared::HitData> shadows = software.occluded(rays), bruteShadows = brute.occluded(rays);
    size_t disagreements = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const bool same = a[i].t == b[i].t && a[i].instance == b[i].instance && a[i].primitive == b[i].primitive &&
                          a[i].u == b[i].u && a[i].v == b[i].v;
        disagreements += same && shadows[i].t == bruteShadows[i].t ? 0u : 1u;
    }
    EXPECT_EQ(disagreements, 0u) << "software against brute, all rays";
    std::vector<shared::RayData> offFaces;
    for (const shared::RayData& ray : rays)
        if (ray.tMin > 0.0f) offFaces.push_back(ray);  // at a face, t is 0 but for rounding: not decidable from 0 on
    const Agreement agreement = compareWithOracle(device_, scene, offFaces, 1e-4);
    EXPECT_EQ(agreement.wrongHits, 0u);
    EXPECT_EQ(agreement.wrongDistances, 0u);
    EXPECT_EQ(agreement.wrongShadows, 0u);
    EXPECT_GT(agreement.hits, 500u);
}

/// Of 200 equal triangles the lowest id wins, whatever the tree does.
TEST_F(TraceOracle, LowestIdWinsAmongDuplicates) {
    Scene scene;
    const uint32_t material = addMaterial(scene, lambert(0.5f));
    accel_test::TestMesh mesh;
    for (int i = 0; i < 200; ++i) mesh.add({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
    addMesh(scene, meshOf(mesh, material));
    addMesh(scene, meshOf(mesh, material));
    RayCaster caster(device_, scene, {});
    Random random(88);
    std::vector<shared::RayData> rays;
    for (int i = 0; i < 1000; ++i)
        rays.push_back(makeRay({random.uniform(-0.4f, 0.9f), random.uniform(-0.4f, 0.9f), 2.0f}, {0, 0, -1}));
    for (const shared::HitData& hit : caster.closest(rays)) {
        EXPECT_EQ(hit.t, 2.0f);
        EXPECT_EQ(hit.instance, 0u);
        EXPECT_EQ(hit.primitive, 0u);
    }
}

}  // namespace
}  // namespace raylab::support
