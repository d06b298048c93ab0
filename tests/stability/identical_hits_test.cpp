#include <array>

#include "engine/accel/builders.h"
#include "engine/scene/import.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"

/// The closest hit must not depend on the builder, the layout, the size of leaves, or whether instances are flattened:
/// 1e7 rays in all, of which 30 x 300,000 through a soup, 9 x 100,000 through Sponza and 5 x 50,000 at the dragon.
namespace raylab::support {
namespace {

using accel_test::Random;
using accel_test::TestMesh;

using IdenticalHits = GpuTest;

/// Triangles of all sizes, every fifth of them twice more in another order of ids, and a crossing of coplanar ones.
Scene soupWithDuplicates() {
    TestMesh mesh = accel_test::randomSoup(2000, 0.15f, 141);
    const std::vector<glm::uvec3> once = mesh.triangles;
    for (size_t i = 0; i < once.size(); i += 5)
        mesh.triangles.insert(mesh.triangles.end(), 2, once[once.size() - 1 - i]);
    Random random(142);
    for (int i = 0; i < 200; ++i) {
        const glm::vec2 p(random.uniform(0.0f, 0.8f), random.uniform(0.0f, 0.8f));
        mesh.add({p, 0.5f}, {p.x + 0.2f, p.y, 0.5f}, {p.x, p.y + 0.2f, 0.5f});
    }
    Scene scene = sceneOf(mesh);
    addInstance(scene, 0, glm::mat4(1.0f));
    return scene;
}

/// All combinations, leaf sizes in turn.
std::vector<RenderSettings> everyBuilderAndLayout() {
    std::vector<RenderSettings> choices;
    for (RenderSettings settings : everyLayout())
        for (const BuilderInfo& builder : builders()) {
            settings.builder = builder.name;
            settings.leafSize = std::array{1, 2, 4, 8, 16}[choices.size() % 5];
            choices.push_back(settings);
        }
    return choices;
}

void expectIdentical(Device& device, const Scene& scene, const std::vector<shared::RayData>& rays,
                     const std::vector<RenderSettings>& choices) {
    std::vector<shared::HitData> first;
    for (const RenderSettings& settings : choices) {
        RayCaster caster(device, scene, settings);
        const std::vector<shared::HitData> hits = caster.closest(rays);
        if (first.empty()) first = hits;
        EXPECT_EQ(countDifferentHits(hits, first), 0u) << nameOf(settings) << " against " << nameOf(choices.front());
    }
    size_t met = 0;
    for (const shared::HitData& hit : first) met += hit.t >= 0.0f ? 1u : 0u;
    EXPECT_GT(met, rays.size() / 4);
}

TEST_F(IdenticalHits, SoupWithDuplicates) {
    const Scene scene = soupWithDuplicates();
    expectIdentical(device_, scene, randomRays(scene, 300'000, 143), everyBuilderAndLayout());
}

/// In a room, 150,000 triangles of 5e-4 across: some of them each ray sees edge-on, far beside it, where its rounding is as large
/// as they are. No tree asks for them; brute force does.
TEST_F(IdenticalHits, SmallTrianglesFarBesideTheRays) {
    TestMesh mesh;
    Random random(147);
    for (int i = 0; i < 150'000; ++i) {
        const glm::vec3 p = random.inCube(-15.0f, 15.0f);
        mesh.add(p, p + 5e-4f * random.direction(), p + 5e-4f * random.direction());
    }
    const auto wall = [&](const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
        mesh.add(corner, corner + u, corner + u + v);
        mesh.add(corner, corner + u + v, corner + v);
    };
    const glm::vec3 x(40.0f, 0.0f, 0.0f), y(0.0f, 40.0f, 0.0f), z(0.0f, 0.0f, 40.0f), low(-20.0f);
    wall(low, x, y), wall(low + z, x, y), wall(low, y, z), wall(low + x, y, z), wall(low, x, z), wall(low + y, x, z);
    Scene scene = sceneOf(mesh);
    addInstance(scene, 0, glm::mat4(1.0f));
    RenderSettings brute;
    brute.tracer = "brute";
    expectIdentical(device_, scene, randomRays(scene, 800, 148), {RenderSettings{}, brute});
}

/// Every layout by the default builder, and every other builder by the default layout.
std::vector<RenderSettings> layoutsAndBuilders() {
    std::vector<RenderSettings> choices = everyLayout();
    for (const BuilderInfo& builder : builders()) {
        if (builder.name == kDefaultBuilder || builder.name == "median") continue;
        choices.emplace_back();
        choices.back().builder = builder.name;
    }
    return choices;
}

TEST_F(IdenticalHits, Sponza) {
    const std::optional<std::filesystem::path> path = sharedScene("sponza-crytek/Sponza.gltf");
    if (!path) return;
    Scene scene = importScene(*path);
    makeSolid(scene);
    expectIdentical(device_, scene, randomRays(scene, 100'000, 144), layoutsAndBuilders());
}

TEST_F(IdenticalHits, Dragon) {
    const std::optional<TestMesh> dragon = accel_test::readDragon();
    if (!dragon) GTEST_SKIP() << accel_test::kNoDragon;
    const Scene scene = sceneOf(*dragon);
    std::vector<RenderSettings> choices = everyLayout();
    choices[1].builder = "linear";  // bvh2q gives the dragon a tree of its own, which moves no vertex
    expectIdentical(device_, scene, randomRays(scene, 50'000, 145), choices);
}

/// In world space and below instances t is rounded differently: hits may differ where no float can decide, and only
/// there.
TEST_F(IdenticalHits, FlattenedAndBelowInstances) {
    const Scene scene = instancedSoup();
    const OracleCase oracle(scene, randomRays(scene, 20'000, 146), 1e-4);
    std::vector<shared::HitData> below;
    for (const RenderSettings& settings : everyLayout()) {
        RayCaster flattened(device_, scene, settings), instanced(device_, scene, twoLevels(settings));
        const std::vector<shared::HitData> world = flattened.closest(oracle.rays),
                                           object = instanced.closest(oracle.rays);
        if (below.empty()) below = object;
        EXPECT_EQ(countDifferentHits(object, below), 0u) << nameOf(settings) << ": below instances";
        for (size_t i = 0; i < world.size(); ++i) {
            const bool same = (world[i].t >= 0.0f) == (object[i].t >= 0.0f) &&
                              world[i].instance == object[i].instance && world[i].primitive == object[i].primitive;
            EXPECT_TRUE(same || !isDecidable(oracle.expected[i], oracle.margin)) << nameOf(settings) << ", ray " << i;
        }
    }
}

}  // namespace
}  // namespace raylab::support
