#include <algorithm>
#include <array>
#include <cmath>

#include "engine/accel/brute_force.h"
#include "engine/accel/builders.h"
#include "engine/accel/triangle_watertight.h"
#include "engine/accel/walk_tree.h"
#include "tests/support/fuzz.h"
#include "tests/unit/accel_build_support.h"

/// Every builder and every layout over generated meshes that are as unpleasant as files are: what holds of a tree, and
/// that no walk loses a hit that brute force has and double precision confirms.
namespace raylab {
namespace {

using accel_test::kNodeBase;
using accel_test::kSlotBase;
using accel_test::Random;
using accel_test::TestMesh;

constexpr size_t kRays = 24;
constexpr double kMargin = 1e-3;  ///< of a hit's barycentric coordinates, and of the next hit's distance

size_t countFrom(Random& random) {
    return 1 + static_cast<size_t>(random.uniform(0.0f, 1.0f) * random.uniform(0.0f, 250.0f));
}

glm::vec3 onGrid(Random& random, float cells) { return glm::floor(random.inCube(0.0f, cells)); }

/// One centroid, many sizes.
TestMesh equalCentroids(Random& random) {
    TestMesh mesh;
    for (size_t i = countFrom(random); i > 0; --i) {
        const glm::vec3 a = random.uniform(0.0f, 1.0f) * random.direction(),
                        b = random.uniform(0.0f, 1.0f) * random.direction();
        mesh.add(a, b, -a - b);
    }
    return mesh;
}

/// Points, lines and few real triangles.
TestMesh zeroAreas(Random& random) {
    TestMesh mesh;
    for (size_t i = countFrom(random); i > 0; --i) {
        const glm::vec3 a = random.inCube(-1.0f, 1.0f), b = random.inCube(-1.0f, 1.0f);
        const float kind = random.uniform(0.0f, 3.0f);
        mesh.add(a, kind < 1.0f ? a : b, kind < 1.0f ? a : kind < 2.0f ? 0.5f * (a + b) : random.inCube(-1.0f, 1.0f));
    }
    return mesh;
}

TestMesh collinearStrip(Random& random) {
    TestMesh mesh;
    const glm::vec3 along = random.direction(), across = 1e-3f * random.direction();
    for (size_t i = countFrom(random); i > 0; --i) {
        const float at = static_cast<float>(i);
        mesh.add(at * along, (at + 1.0f) * along, at * along + across);
    }
    return mesh;
}

TestMesh hugeAmongTiny(Random& random) {
    TestMesh mesh = accel_test::randomSoup(countFrom(random), 1e-3f, random.below(1'000'000));
    for (int i = 0; i < 3; ++i)
        mesh.add(1e4f * random.direction(), 1e4f * random.direction(), 1e4f * random.direction());
    return mesh;
}

/// Few triangles, each many times.
TestMesh duplicates(Random& random) {
    const TestMesh few = accel_test::randomSoup(3, 0.5f, random.below(1'000'000));
    TestMesh mesh;
    for (size_t i = countFrom(random); i > 0; --i) {
        const glm::uvec3& t = few.triangles[i % few.triangles.size()];
        mesh.add(few.positions[t.x], few.positions[t.y], few.positions[t.z]);
    }
    return mesh;
}

/// In one plane across an axis, at coordinates that boxes share.
TestMesh flat(Random& random) {
    TestMesh mesh;
    const int axis = static_cast<int>(random.below(3));
    for (size_t i = countFrom(random); i > 0; --i) {
        std::array<glm::vec3, 3> p = {onGrid(random, 8.0f), onGrid(random, 8.0f), onGrid(random, 8.0f)};
        for (glm::vec3& corner : p) corner[axis] = 3.0f;
        mesh.add(p[0], p[1], p[2]);
    }
    return mesh;
}

/// Sizes and places of 2^i: no plane divides them evenly.
TestMesh geometricScales(Random& random) {
    TestMesh mesh;
    const float base = random.uniform(1.2f, 4.0f);
    for (size_t i = std::min<size_t>(countFrom(random), 24); i > 0; --i) {
        const float size = std::pow(base, static_cast<float>(i) - 12.0f);
        mesh.add(glm::vec3(size), size * glm::vec3(2, 1, 1), size * glm::vec3(1, 2, 1.5f));
    }
    return mesh;
}

TestMesh farAway(Random& random) {
    TestMesh mesh = accel_test::randomSoup(countFrom(random), 0.3f, random.below(1'000'000));
    const glm::vec3 offset = std::pow(10.0f, random.uniform(2.0f, 7.0f)) * random.direction();
    for (glm::vec3& p : mesh.positions) p += offset;
    return mesh;
}

/// All of a soup at one scale: of denormals, of the largest that is taken in, and beyond.
TestMesh extremeScale(Random& random) {
    TestMesh mesh = accel_test::randomSoup(countFrom(random), 0.3f, random.below(1'000'000));
    constexpr std::array kScales = {1e-41f, 1e-38f, 1e-30f, 1e-18f, 1e9f, 5e14f, 1e15f, 1e18f, 1e30f};
    const float scale = kScales[random.below(kScales.size())];
    for (glm::vec3& p : mesh.positions) p *= scale;
    return mesh;
}

/// Each triangle at a scale of its own.
TestMesh mixedScales(Random& random) {
    TestMesh mesh;
    for (size_t i = countFrom(random); i > 0; --i) {
        const glm::vec3 p = random.inCube(-1.0f, 1.0f);
        const float size = std::pow(10.0f, random.uniform(-30.0f, 14.5f));
        mesh.add(size * p, size * (p + random.direction()), size * (p + random.direction()));
    }
    return mesh;
}

TestMesh single(Random& random) {
    return accel_test::randomSoup(1, random.uniform(0.0f, 1.0f), random.below(1'000'000));
}

struct MeshKind {
    const char* name;
    TestMesh (*make)(Random&);
};
constexpr std::array kMeshKinds = {MeshKind{"equalCentroids", equalCentroids},
                                   MeshKind{"zeroAreas", zeroAreas},
                                   MeshKind{"collinearStrip", collinearStrip},
                                   MeshKind{"hugeAmongTiny", hugeAmongTiny},
                                   MeshKind{"duplicates", duplicates},
                                   MeshKind{"flat", flat},
                                   MeshKind{"geometricScales", geometricScales},
                                   MeshKind{"farAway", farAway},
                                   MeshKind{"extremeScale", extremeScale},
                                   MeshKind{"mixedScales", mixedScales},
                                   MeshKind{"single", single}};

BvhConfig configFrom(Random& random) {
    BvhConfig config;
    config.maxLeafSize = 1 + static_cast<int>(random.below(kMaxLeafSize));
    config.bins = 2 + static_cast<int>(random.below(kMaxBvhBins - 1));
    config.maxDepth = 12 + static_cast<int>(random.below(kMaxBvhDepth - 11));
    config.spatialBudget = random.uniform(0.0f, 2.0f);
    return config;
}

struct FloatHit {
    float t = std::numeric_limits<float>::infinity();
    uint32_t primitive = kNoPrimitive;
};

/// The closest so far, of equal ones the lowest id.
void testTriangle(const TestMesh& mesh, const WatertightRay& ray, uint32_t id, FloatHit& best) {
    const glm::uvec3& triangle = mesh.triangles[id];
    float t = 0.0f, u = 0.0f, v = 0.0f;
    if (!intersectWatertight(ray, mesh.positions[triangle.x], mesh.positions[triangle.y], mesh.positions[triangle.z],
                             0.0f, best.t, t, u, v))
        return;
    if (t < best.t || id < best.primitive) best = {t, id};
}

/// What a ray is to find: by float over all triangles that a tree takes in, and whether double precision confirms it.
struct Expected {
    OracleRay ray;
    FloatHit hit;
    bool confirmed = false;
};

/// Rays to points of triangles from no further away than ten times their size.
std::vector<Expected> raysInto(const TestMesh& mesh, const std::vector<Aabb>& bounds, Random& random) {
    std::vector<uint32_t> usable;
    TestMesh seen{mesh.positions, {}};
    for (uint32_t i = 0; i < bounds.size(); ++i)
        if (bounds[i].usable()) {
            usable.push_back(i);
            seen.triangles.push_back(mesh.triangles[i]);
        }
    std::vector<Expected> all;
    for (size_t i = 0; i < kRays && !usable.empty(); ++i) {
        const Aabb& box = bounds[usable[i % usable.size()]];
        const float size = std::max(glm::length(box.extent()), 1e-37f);
        Expected e;
        e.ray.o = box.centroid() + random.uniform(0.0f, 10.0f) * size * random.direction();
        const glm::vec3 to = box.centroid() + random.inCube(-0.4f, 0.4f) * box.extent() - e.ray.o;
        const float length = glm::length(to);
        e.ray.d = length > 0.0f ? to / length : random.direction();
        if (i % 8 == 0) e.ray.d = {0.0f, random.uniform(-1.0f, 1.0f) < 0.0f ? -1.0f : 1.0f, 0.0f};
        const WatertightRay watertight = makeWatertightRay(e.ray.o, e.ray.d);
        for (const uint32_t id : usable) testTriangle(mesh, watertight, id, e.hit);
        const OracleHit oracle = closestHitDouble(seen.positions, seen.triangles, e.ray.o, e.ray.d, 0.0f);
        e.confirmed = oracle.hit() && usable[oracle.primitive] == e.hit.primitive && oracle.margin > kMargin &&
                      oracle.tNext > oracle.t * (1.0 + kMargin) && oracle.t > 0.0 &&
                      std::abs(static_cast<double>(e.hit.t) - oracle.t) < kMargin * oracle.t;
        all.push_back(e);
    }
    return all;
}

/// Walks of a layout find what brute force finds. Returns how many confirmed hits there were.
size_t checkWalks(const std::string& layout, const Bvh& bvh, const TestMesh& mesh, const std::vector<Expected>& rays) {
    const FlatTree tree = flatten(layout, bvh, kNodeBase, kSlotBase);
    size_t confirmed = 0;
    for (const Expected& expected : rays) {
        FloatHit hit;
        float tMax = hit.t;
        const WatertightRay watertight = makeWatertightRay(expected.ray.o, expected.ray.d);
        const auto testLeaf = [&](uint32_t first, uint32_t count) {
            for (uint32_t slot = first - kSlotBase; slot < first - kSlotBase + count; ++slot)
                testTriangle(mesh, watertight, tree.order.at(slot), hit);
            tMax = hit.t;
        };
        const uint32_t entries =
            walkTree(layout, tree, kNodeBase, expected.ray.o, expected.ray.d, 0.0f, tMax, testLeaf);
        EXPECT_LE(entries, tree.stackEntries);
        EXPECT_GE(hit.t, expected.hit.t) << "a hit that brute force does not have";
        if (!expected.confirmed) continue;
        ++confirmed;
        EXPECT_EQ(hit.primitive, expected.hit.primitive);
        EXPECT_EQ(hit.t, expected.hit.t);
    }
    return confirmed;
}

class AccelFuzz : public testing::TestWithParam<std::string> {
protected:
    /// One mesh, by a config of its own, in every layout.
    size_t round(const MeshKind& kind, uint32_t seed) const {
        Random random(seed);
        const TestMesh mesh = kind.make(random);
        const std::vector<Aabb> bounds = accel_test::boundsOf(mesh);
        const BvhConfig wanted = configFrom(random);
        const std::vector<Expected> rays = raysInto(mesh, bounds, random);
        size_t confirmed = 0;
        for (const LayoutInfo& layout : layouts()) {
            SCOPED_TRACE(std::string(kind.name) + ", seed " + std::to_string(seed) + ", " + std::string(layout.name));
            BvhConfig config = wanted;
            config.maxLeafSize = std::min(config.maxLeafSize, layout.maxLeafSize);
            const Bvh bvh = buildBvh(GetParam(), accel_test::inputOf(mesh, bounds), config);
            const bool tight = !accel_test::mayListAgain(GetParam());
            accel_test::checkTree(bvh, bounds, config, tight);
            EXPECT_LE(static_cast<double>(bvh.order.size() + bvh.skipped),
                      (1.0 + static_cast<double>(config.spatialBudget)) * static_cast<double>(bounds.size()));
            confirmed += checkWalks(std::string(layout.name), bvh, mesh, rays);
        }
        return confirmed;
    }
};

INSTANTIATE_TEST_SUITE_P(, AccelFuzz, testing::ValuesIn(builderNames()), [](const auto& test) { return test.param; });

TEST_P(AccelFuzz, TreesHoldAndWalksLoseNothing) {
    constexpr uint32_t kRounds = 12;
    for (const MeshKind& kind : kMeshKinds) {
        size_t confirmed = 0;
        for (uint32_t seed = 1; seed <= kRounds * support::fuzzRepeats() && !HasFailure(); ++seed)
            confirmed += round(kind, seed);
        // Lines and identical triangles have no hit that is decided.
        const bool decided = std::string(kind.name) != "collinearStrip" && std::string(kind.name) != "duplicates";
        EXPECT_TRUE(confirmed > 0 || !decided) << kind.name << ": the rays hit nothing";
    }
}

}  // namespace
}  // namespace raylab
