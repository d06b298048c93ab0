#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/error.h"
#include "engine/measure/hit_oracle.h"
#include "engine/measure/stability/cases.h"
#include "engine/measure/stability/oracle_case.h"
#include "engine/measure/stability/ray_sets.h"
#include "engine/measure/stability/render_case.h"

namespace raylab::stability {
namespace {

/// Embree's own choice, where a unit in the last place is 1/64; it allows 2e-5 there in its robust mode.
const glm::vec3 kFarAway(148376.0f, 1234.0f, -223423.0f);
constexpr double kAllowedFarAway = 2e-5;

struct Closed {
    TestMesh mesh;
    glm::vec3 centre;
    std::string what;
};

/// Closed meshes at the origin and, where there is a second one, far away.
std::vector<Closed> closedScene(size_t which) {
    const glm::vec3 zero(0.0f);
    if (which == 0)
        return {{ball(50, zero), zero, "ball, 50 rings"}, {ball(200, kFarAway), kFarAway, "ball, 200 rings"}};
    if (which == 1)
        return {{ball(200, zero), zero, "ball, 200 rings"}, {ball(50, kFarAway), kFarAway, "ball, 50 rings"}};
    return {{bumpyBall(50), zero, "bumpy ball"}};
}

std::vector<shared::RayData> raysFor(const Closed& closed, size_t count) {
    std::vector<shared::RayData> rays = raysAtEdges(closed.mesh, closed.centre, count / 2);
    const std::vector<shared::RayData> others = raysFromInside(closed.centre, count - rays.size());
    rays.insert(rays.end(), others.begin(), others.end());
    return rays;
}

Number leakNumber(const Context& context, const Closed& closed, std::span<const shared::RayData> rays,
                  std::span<const shared::HitData> hits) {
    std::vector<size_t> wrong;
    for (size_t i = 0; i < rays.size(); ++i)
        if (hits[i].t < 0.0f) wrong.push_back(i);
    const bool isFar = closed.centre != glm::vec3(0.0f);
    Number number{"leaks from a " + closed.what + (isFar ? ", far away" : ", at the origin"),
                  static_cast<double>(wrong.size()) / static_cast<double>(rays.size()),
                  isFar ? kAllowedFarAway : 0.0,
                  "of rays",
                  std::to_string(wrong.size()) + " of " + std::to_string(rays.size()),
                  std::nullopt};
    showWrongRays(number, sceneOf(closed.mesh), context.settings, rays, wrong);
    return number;
}

double doubleArea(const TestMesh& mesh, const glm::uvec3& t) {
    const glm::dvec2 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The square -1 .. 1 at z = 0, its triangles cut again and again by a point inside, often close to a corner.
TestMesh cutSquare(size_t count) {
    Random random(101);
    TestMesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    for (size_t at = 0; mesh.triangles.size() < count; at = (at + 1) % mesh.triangles.size()) {
        glm::uvec3& whole = mesh.triangles[at];
        const float small = std::pow(10.0f, random.uniform(-3.0f, -0.3f));
        const float part = random.uniform(0.1f, 0.9f);
        const auto corner = static_cast<int>(random.below(3));
        const glm::vec3 a = mesh.positions[whole[corner]];
        const glm::vec3 b = mesh.positions[whole[(corner + 1) % 3]], c = mesh.positions[whole[(corner + 2) % 3]];
        mesh.positions.push_back(a + small * (part * (b - a) + (1.0f - part) * (c - a)));
        const auto added = static_cast<uint32_t>(mesh.positions.size() - 1);
        const glm::uvec3 parts[] = {{whole.x, whole.y, added}, {whole.y, whole.z, added}, {whole.z, whole.x, added}};
        if (std::all_of(std::begin(parts), std::end(parts),
                        [&](const glm::uvec3& t) { return doubleArea(mesh, t) > 0.0; })) {
            whole = parts[0];  // before the reference goes
            mesh.triangles.insert(mesh.triangles.end(), {parts[1], parts[2]});
        } else {
            mesh.positions.pop_back();
        }
    }
    return mesh;
}

float shortestEdge(const TestMesh& mesh) {
    float shortest = 1e30f;
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            shortest = std::min(shortest, glm::distance(mesh.positions[t[i]], mesh.positions[t[(i + 1) % 3]]));
    return shortest;
}

std::vector<shared::RayData> raysThroughSquare(size_t count) {
    Random random(102);
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 origin(random.uniform(-3.0f, 3.0f), random.uniform(-3.0f, 3.0f), random.uniform(0.5f, 3.0f));
        const glm::vec3 target(random.uniform(-0.99f, 0.99f), random.uniform(-0.99f, 0.99f), 0.0f);
        rays.push_back(makeRay(origin, target - origin));
    }
    return rays;
}

/// `wrong`: rays, shown by where they meet the square.
Number squareNumber(const Context& context, const std::string& what, const TestMesh& mesh,
                    std::span<const shared::RayData> rays, const std::vector<size_t>& wrong) {
    Number number = rayNumber(what, sceneOf(mesh), context.settings, rays, wrong, rays.size());
    std::vector<glm::dvec2> targets;
    for (const size_t i : wrong) targets.push_back((glm::dvec2(rays[i].origin + rays[i].direction) + 1.0) / 2.0);
    if (!number.passes()) number.picture = scatterPicture(targets);
    return number;
}

/// Rays that are wrong in double precision, where they differ from `expected`.
std::vector<size_t> wrongRays(const Scene& scene, std::span<const shared::RayData> rays,
                              std::span<const shared::HitData> hits, std::span<const shared::HitData> expected) {
    const HitOracle oracle(scene);
    std::vector<size_t> wrong;
    for (uint32_t i = 0; i < rays.size(); ++i) {
        if (isSameHit(hits[i], expected[i])) continue;
        const Verdict verdict = oracle.judgeClosest(rays[i], i, expected[i], hits[i]).verdict;
        if (verdict == Verdict::aRight || verdict == Verdict::neither) wrong.push_back(i);
    }
    return wrong;
}

Number axisNumber(const Context& context, const std::string& what, const std::vector<shared::RayData>& rays,
                  const std::vector<size_t>& wrong) {
    std::vector<glm::dvec2> where;
    for (const size_t i : wrong) where.emplace_back((glm::dvec2(rays[i].origin) + 2.0) / 11.0);
    Number number{what,   static_cast<double>(wrong.size()),   0.0,
                  "rays", "of " + std::to_string(rays.size()), std::nullopt};
    if (!number.passes()) number.picture = scatterPicture(where);
    if (!wrong.empty()) number.evidence = rayEvidence(gridOfCubes(), context.settings, rays, wrong);
    return number;
}

std::vector<size_t> differentHits(std::span<const shared::HitData> a, std::span<const shared::HitData> b) {
    std::vector<size_t> different;
    for (size_t i = 0; i < a.size(); ++i)
        if (!isSameHit(a[i], b[i])) different.push_back(i);
    return different;
}

}  // namespace

std::vector<Number> measureLeaksOf(const Context& context, size_t which, size_t count) {
    const std::vector<Closed> meshes = closedScene(which);
    Scene scene;
    const uint32_t material = addMaterial(scene, lambert(0.5f));
    for (const Closed& closed : meshes) addMesh(scene, meshOf(closed.mesh, material));
    RayCaster caster(context.device, scene, context.settings);
    std::vector<Number> numbers;
    for (const Closed& closed : meshes) {
        context.check();
        const std::vector<shared::RayData> rays = raysFor(closed, count);
        numbers.push_back(leakNumber(context, closed, rays, caster.closest(rays)));
    }
    return numbers;
}

std::vector<Number> measureLeaks(const Context& context) {
    if (context.settings.tracer == "brute") throw Skipped("brute force tests 240,000 triangles a ray");
    std::vector<Number> numbers;
    for (size_t which = 0; which < 3; ++which)
        for (Number& number : measureLeaksOf(context, which, context.rays(1'000'000)))
            numbers.push_back(std::move(number));
    return numbers;
}

/// As in the Khronos conformance tests. A second hit is behind the first or, where it is exactly as far, found first
/// when ids count down.
std::vector<Number> measureSingleHit(const Context& context) {
    if (context.settings.tracer == "brute") throw Skipped("brute force tests 20,000 triangles a ray");
    const TestMesh mesh = cutSquare(20000);
    TestMesh reversed = mesh;
    std::reverse(reversed.triangles.begin(), reversed.triangles.end());
    std::vector<shared::RayData> rays = raysThroughSquare(65536);
    RayCaster caster(context.device, sceneOf(mesh), context.settings),
        reversedCaster(context.device, sceneOf(reversed), context.settings);
    const std::vector<shared::HitData> first = caster.closest(rays), other = reversedCaster.closest(rays);
    for (size_t i = 0; i < rays.size(); ++i) rays[i].tMin = std::max(first[i].t, 0.0f);
    const std::vector<shared::HitData> behind = caster.occluded(rays);
    std::vector<size_t> misses, doubles;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (first[i].t < 0.0f)
            misses.push_back(i);
        else if (behind[i].t >= 0.0f || first[i].primitive + other[i].primitive + 1 != mesh.triangles.size())
            doubles.push_back(i);
    }
    return {squareNumber(context, "misses", mesh, rays, misses),
            squareNumber(context, "double hits", mesh, rays, doubles),
            {"shortest edge of the cut square", static_cast<double>(shortestEdge(mesh)), 1.5e-6, "units", "",
             std::nullopt}};
}

AxisAnswers axisAnswers(const Context& context, size_t count) {
    RenderSettings settings = context.settings;
    settings.tracer = "brute";
    RayCaster brute(context.device, gridOfCubes(), settings);
    AxisAnswers answers;
    answers.rays = raysAlongAxes(count, 87);
    answers.closest = brute.closest(answers.rays);
    answers.occluded = brute.occluded(answers.rays);
    return answers;
}

std::vector<Number> measureAxisRaysAgainst(const Context& context, const AxisAnswers& expected) {
    const Scene scene = gridOfCubes();
    RayCaster caster(context.device, scene, context.settings);
    const std::vector<shared::HitData> hits = caster.closest(expected.rays);
    if (context.isTracedByDriver())
        return {axisNumber(context, "rays along axes that are wrong", expected.rays,
                           wrongRays(scene, expected.rays, hits, expected.closest))};
    return {axisNumber(context, "closest hits that are not brute force's", expected.rays,
                       differentHits(hits, expected.closest)),
            axisNumber(context, "shadow rays that are not brute force's", expected.rays,
                       differentHits(caster.occluded(expected.rays), expected.occluded))};
}

std::vector<Number> measureAxisRays(const Context& context) {
    return measureAxisRaysAgainst(context, axisAnswers(context, context.rays(100'000)));
}

}  // namespace raylab::stability
