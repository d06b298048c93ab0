#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/accel/builders.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/measure/stability/cases.h"
#include "engine/measure/stability/oracle_case.h"
#include "engine/measure/stability/ray_sets.h"
#include "engine/measure/stability/render_case.h"
#include "engine/scene/import.h"

namespace raylab::stability {
namespace {

TestMesh identicalTriangles(size_t count) {
    TestMesh mesh;
    for (size_t i = 0; i < count; ++i) mesh.add({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
    return mesh;
}

bool isSameTree(const Bvh& a, const Bvh& b) {
    return a.order == b.order && a.depth == b.depth && a.nodes.size() == b.nodes.size() &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0;
}

Bvh build(std::string_view builder, const TestMesh& mesh, int maxDepth) {
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    BvhConfig config;
    config.maxDepth = maxDepth;
    return buildBvh(builder, {bounds, mesh.positions, mesh.triangles}, config);
}

/// The first corner opposite to the sum of the others: centroids at the origin, of all sizes.
TestMesh equalCentroids(size_t count) {
    Random random(121);
    TestMesh mesh;
    for (size_t i = 0; i < count; ++i) {
        const float size = std::pow(2.0f, random.uniform(-12.0f, 0.0f));
        const glm::vec3 a = size * random.direction(), b = size * random.direction();
        mesh.add(a, b, -a - b);
    }
    return mesh;
}

/// From 2^-30 on: the watertight test multiplies two lengths, and the product must not come close to denormals.
float geometricSize(size_t i) { return std::ldexp(1.0f, static_cast<int>(i % 60) - 30); }

TestMesh geometricSizes(size_t count) {
    Random random(122);
    TestMesh mesh;
    for (size_t i = 0; i < count; ++i) {
        const float size = geometricSize(i);
        const glm::vec3 p = size * random.direction();
        mesh.add(p, p + size * random.direction(), p + size * random.direction());
    }
    return mesh;
}

/// A strip whose triangles grow along X and are sorted by it.
TestMesh sortedStrip(size_t count) {
    TestMesh mesh;
    float x = 1.0f;
    for (size_t i = 0; i < count; ++i) {
        const float next = x * 1.005f;
        mesh.add({x, 0, 0}, {next, 0, 0.1f * x}, {x, 0.5f * x, 0});
        x = next;
    }
    return mesh;
}

std::vector<shared::RayData> raysAmongSizes(size_t count) {
    Random random(124);
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 origin = geometricSize(i) * random.direction();
        rays.push_back(makeRay(origin, 1e-2f * glm::length(origin) * random.direction() - origin));
    }
    return rays;
}

std::vector<shared::RayData> raysAtStrip(size_t count) {
    Random random(125);
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < count; ++i) {
        const float x = std::pow(1.005f, random.uniform(1.0f, 1999.0f));
        const glm::vec3 target(x, random.uniform(0.0f, 0.4f) * x, 0.0f);
        const glm::vec3 origin = target + x * glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), 2.0f);
        rays.push_back(makeRay(origin, target - origin));
    }
    return rays;
}

std::string ofText(size_t whole) { return "of " + std::to_string(whole); }

/// Wrong closest and any hits, and entries of the stack that a counting kernel used beyond those it has.
void measureLost(const Context& context, const Scene& scene, std::vector<shared::RayData> rays, const std::string& what,
                 std::vector<Number>& numbers) {
    context.check();
    const OracleCase oracle(scene, std::move(rays), 1e-3);
    RayCaster caster(context.device, scene, context.settings);
    const Agreement agreement = compareWithOracle(caster, oracle);
    if (agreement.hits <= oracle.rays.size() / 10) throw Error(what + ": too few rays hit to tell anything");
    numbers.push_back(rayNumber("wrong hits: " + what, scene, context.settings, oracle.rays, agreement.raysOfHits,
                                agreement.decidable));
    Number shadows =
        countOf("wrong shadow rays: " + what, agreement.wrongShadows, "rays", ofText(3 * agreement.decidable));
    showWrongRays(shadows, scene, context.settings, oracle.rays, agreement.raysOfShadows);
    numbers.push_back(std::move(shadows));
    if (!context.hasTree()) return;
    uint32_t high = 0;
    for (const shared::RayCounts& counts : caster.count(oracle.rays, false).counts)
        high = std::max(high, counts.stackHigh);
    const uint32_t allocated = caster.prepared().tracer->traceData().stackEntries;
    numbers.push_back(countOf("stack beyond its end: " + what, high > allocated ? high - allocated : 0, "entries",
                              "at most " + std::to_string(high) + " in use of " + std::to_string(allocated)));
}

/// Levels of all builders' trees above the cap.
Number capNumber(const TestMesh& mesh, int maxDepth, const std::string& what) {
    size_t above = 0;
    uint32_t deepest = 0;
    for (const BuilderInfo& builder : builders()) {
        const uint32_t depth = build(builder.name, mesh, maxDepth).depth;
        deepest = std::max(deepest, depth);
        above += depth > static_cast<uint32_t>(maxDepth) ? depth - static_cast<uint32_t>(maxDepth) : 0;
    }
    return countOf("levels above the builders' cap: " + what, above, "levels",
                   std::to_string(deepest) + " of " + std::to_string(maxDepth) + ", " +
                       std::to_string(mesh.triangles.size()) + " triangles");
}

Number instancesNumber(const Context& context, const OracleCase& oracle, const Scene& scene, const std::string& what) {
    RayCaster caster(context.device, scene, context.settings);
    const Agreement agreement = compareWithOracle(caster, oracle);
    if (agreement.hits <= oracle.rays.size() / 20) throw Error(what + ": too few rays hit to tell anything");
    Number number = countOf("wrong hits and shadows: " + what, agreement.wrongHits + agreement.wrongShadows, "rays",
                            ofText(agreement.decidable));
    std::vector<size_t> wrong = agreement.raysOfHits;
    wrong.insert(wrong.end(), agreement.raysOfShadows.begin(), agreement.raysOfShadows.end());
    showWrongRays(number, scene, context.settings, oracle.rays, wrong);
    return number;
}

void measureBothWays(const Context& context, const Scene& scene, size_t rays, uint32_t seed, double margin,
                     const std::string& what, std::vector<Number>& numbers) {
    const OracleCase oracle(scene, randomRays(scene, rays, seed), margin);
    for (const bool twoLevels : {false, true}) {
        context.check();
        Context here = context;
        if (twoLevels) here.settings.flattenLimit = 0;
        numbers.push_back(
            instancesNumber(here, oracle, scene, what + (twoLevels ? ", below instances" : ", flattened")));
    }
}

/// Every mesh is shown once more, far to the side: by instances where they are kept.
Scene shownTwice(Scene scene) {
    const size_t count = scene.instances.size();
    for (size_t i = 0; i < count; ++i) {
        Instance again = scene.instances[i];
        again.objectToWorld[3] += glm::vec4(7.0f, 1.0f, 2.0f, 0.0f);
        scene.instances.push_back(again);
    }
    return scene;
}

size_t hitsOf(RayCaster& caster, const std::vector<shared::RayData>& rays) {
    size_t hits = 0;
    for (const auto& answers : {caster.closest(rays), caster.occluded(rays)})
        hits += static_cast<size_t>(
            std::ranges::count_if(answers, [](const shared::HitData& hit) { return hit.t >= 0.0f; }));
    return hits;
}

/// Unit cells in the plane y = 0, two triangles each: what a ray from above hits follows from where it goes.
Mesh unitGrid(uint32_t cells) {
    Mesh mesh;
    for (uint32_t z = 0; z <= cells; ++z)
        for (uint32_t x = 0; x <= cells; ++x) mesh.positions.emplace_back(x, 0.0f, z);
    for (uint32_t z = 0; z < cells; ++z)
        for (uint32_t x = 0; x < cells; ++x) {
            const uint32_t a = z * (cells + 1) + x, b = a + cells + 1;
            mesh.triangles.emplace_back(a, a + 1, b);
            mesh.triangles.emplace_back(a + 1, b + 1, b);
        }
    return mesh;
}

/// More than one storage buffer of lavapipe (128 MiB) holds of triangles.
Number largeNumber(const Context& context) {
    constexpr uint32_t kCells = 1210;
    static_assert(2 * kCells * kCells * sizeof(shared::TraceTriangle) > size_t{128} << 20);
    Scene scene;
    addMaterial(scene, lambert(0.5f));
    addMesh(scene, unitGrid(kCells));
    Random random(132);
    std::vector<shared::RayData> rays;
    std::vector<uint32_t> expected;
    for (int i = 0; i < 10'000; ++i) {
        const glm::uvec2 cell(random.below(kCells), random.below(kCells));
        const bool second = i % 2 == 1;
        const glm::vec2 inside = second ? glm::vec2(0.75f, 0.625f) : glm::vec2(0.25f, 0.125f);
        rays.push_back(
            makeRay({static_cast<float>(cell.x) + inside.x, 1.0f, static_cast<float>(cell.y) + inside.y}, {0, -1, 0}));
        expected.push_back(2 * (cell.y * kCells + cell.x) + (second ? 1u : 0u));
    }
    RayCaster caster(context.device, scene, context.settings);
    const std::vector<shared::HitData> hits = caster.closest(rays);
    std::vector<glm::dvec2> wrong;
    for (size_t i = 0; i < hits.size(); ++i)
        if (hits[i].t != 1.0f || hits[i].primitive != expected[i])
            wrong.push_back(glm::dvec2(rays[i].origin.x, rays[i].origin.z) / static_cast<double>(kCells));
    Number number = countOf("wrong hits on 134 MiB of triangles", wrong.size(), "rays", ofText(rays.size()));
    if (!number.passes()) number.picture = scatterPicture(wrong);
    return number;
}

}  // namespace

std::vector<Number> measureDuplicates(const Context& context) {
    const TestMesh mesh = identicalTriangles(10'000);
    Stopwatch watch;
    const Bvh first = build(context.settings.builder, mesh, BvhConfig{}.maxDepth);
    const double seconds = watch.seconds();
    size_t different = 0;
    for (size_t threads = 1; threads <= 9; ++threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1 + threads % 4);
        different += isSameTree(build(context.settings.builder, mesh, BvhConfig{}.maxDepth), first) ? 0u : 1u;
    }
    Random random(88);
    std::vector<shared::RayData> rays;
    for (int i = 0; i < 64; ++i)
        rays.push_back(makeRay({random.uniform(-0.4f, 0.9f), random.uniform(-0.4f, 0.9f), 2.0f}, {0, 0, -1}));
    RayCaster caster(context.device, sceneOf(mesh), context.settings);
    size_t notLowest = 0, notThere = 0;
    PlotSeries ids{"", {}, false};
    for (const shared::HitData& hit : caster.closest(rays)) {
        ids.points.emplace_back(ids.points.size(), hit.primitive);
        notThere += std::abs(hit.t - 2.0f) <= 1e-6f && hit.primitive < mesh.triangles.size() ? 0u : 1u;
        notLowest += hit.primitive == 0 ? 0u : 1u;
    }
    Number lowest =
        countOf("hits that are not of the lowest id", notLowest, "rays",
                ofText(rays.size()) + (context.isTracedByDriver() ? "; the driver breaks ties as it likes" : ""));
    if (!lowest.passes()) lowest.plot = Plot{"ray", "id of the triangle", false, false, {std::move(ids)}};
    return {{"time to build 10,000 identical triangles", seconds, 5.0, "s", "", std::nullopt},
            countOf("trees that differ, by 1 to 4 threads", different, "of 9", ""),
            countOf("hits that are not where the triangles are", notThere, "rays", ofText(rays.size())),
            std::move(lowest)};
}

std::vector<Number> measureTreeDepth(const Context& context) {
    std::vector<Number> numbers = {capNumber(equalCentroids(context.rays(1'000'000)), 40, "equal centroids")};
    for (const int maxDepth : {16, 40}) {
        context.check();
        numbers.push_back(capNumber(geometricSizes(20'000), maxDepth, "sizes 2^i"));
        numbers.push_back(capNumber(sortedStrip(10'000), maxDepth, "sorted strip"));
    }
    return numbers;
}

std::vector<Number> measureDepth(const Context& context) {
    std::vector<Number> numbers;
    const Scene equal = sceneOf(equalCentroids(20'000));
    measureLost(context, equal, randomRays(equal, context.quick ? 300 : 1000, 123), "equal centroids", numbers);
    measureLost(context, sceneOf(geometricSizes(900)), raysAmongSizes(10'000), "sizes 2^i", numbers);
    measureLost(context, sceneOf(sortedStrip(2000)), raysAtStrip(10'000), "sorted strip", numbers);
    return numbers;
}

/// A detailed thing in a world 1e6 units wide.
std::vector<Number> measureStadium(const Context& context) {
    if (context.settings.tracer == "brute") throw Skipped("brute force tests 871,414 triangles a ray");
    Scene scene = importScene(context.sceneFile("stanford-dragon/dragon_vrip.ply"));
    makeSolid(scene);
    std::vector<shared::RayData> rays = randomRays(scene, 100, 126);
    addMesh(scene, floorQuad(0, 5e5f, -0.1f));
    addMesh(scene, floorQuad(0, 5e5f, 1e5f));
    std::vector<Number> numbers;
    measureLost(context, scene, std::move(rays), "dragon in a stadium", numbers);
    return numbers;
}

std::vector<Number> measureInstances(const Context& context) {
    std::vector<Number> numbers;
    measureBothWays(context, instancedSoup(), 4000, 163, 1e-3, "moved, turned, mirrored, stretched, sheared", numbers);
    Scene scene = soupScene(1000, 0.3f);
    const std::vector<shared::RayData> rays = randomRays(scene, 1000, 162);
    scene.instances.clear();
    RenderSettings settings = context.settings;
    settings.flattenLimit = 0;
    RayCaster caster(context.device, scene, settings);
    numbers.push_back(
        countOf("hits of meshes without an instance", hitsOf(caster, rays), "rays", ofText(2 * rays.size())));
    return numbers;
}

std::vector<Number> measureTrucks(const Context& context) {
    std::vector<Number> numbers;
    for (const auto& [file, what] : {std::pair("truck_mirror_x.gltf", "mirrored truck"),
                                     std::pair("truck_nonuniform_sheared.gltf", "sheared truck")}) {
        Scene scene = shownTwice(importScene(context.sceneFile(std::string("derived-edge-cases/") + file)));
        makeSolid(scene);
        measureBothWays(context, scene, context.quick ? 1000 : 4000, 161, 1e-3, what, numbers);
    }
    size_t silent = 1;
    try {
        importScene(context.sceneFile("derived-edge-cases/truck_singular.gltf"));
    } catch (const Error& error) {
        silent = std::string(error.what()).find("left out for a singular") != std::string::npos ? 0 : 1;
    }
    numbers.push_back(countOf("singular trucks that nobody is told of", silent, "files", ""));
    return numbers;
}

std::vector<Number> measureEmpty(const Context& context) {
    Scene scene;
    addMaterial(scene, lambert(0.5f));
    std::vector<shared::RayData> rays;
    Random random(131);
    for (int i = 0; i < 100; ++i) rays.push_back(makeRay(random.inCube(-1.0f, 1.0f), random.direction()));
    RayCaster caster(context.device, scene, context.settings);
    return {countOf("hits in an empty scene", hitsOf(caster, rays), "rays", ofText(2 * rays.size()))};
}

std::vector<Number> measureLarge(const Context& context) {
    if (context.settings.tracer == "brute") throw Skipped("brute force tests 2.9 million triangles a ray");
    return {largeNumber(context)};
}

}  // namespace raylab::stability
