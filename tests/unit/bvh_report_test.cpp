#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "engine/accel/builders.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/measure/bvh_report.h"
#include "tests/support/scene_build.h"

namespace raylab {
namespace {

using accel_test::TestMesh;

constexpr uint32_t kSeed = 71;

Scene oneMesh(const TestMesh& mesh) {
    Scene scene;
    support::addMesh(scene, support::meshOf(mesh, support::addMaterial(scene, support::lambert(0.5f))));
    return scene;
}

/// Two meshes of unlike quality, shown several times each.
Scene instances() {
    Scene scene;
    const uint32_t material = support::addMaterial(scene, support::lambert(0.5f));
    const std::array meshes{accel_test::randomSoup(300, 0.02f, kSeed), accel_test::randomSlivers(300, kSeed + 1)};
    accel_test::Random random(kSeed + 2);
    for (const TestMesh& mesh : meshes) {
        const auto place = [&] {
            glm::mat4 matrix(1.0f);
            matrix[3] = glm::vec4(random.inCube(-5.0f, 5.0f), 1.0f);
            return matrix;
        };
        const uint32_t index = support::addMesh(scene, support::meshOf(mesh, material), place());
        for (int i = 0; i < 6; ++i) support::addInstance(scene, index, place());
    }
    return scene;
}

TEST(BvhReport, FiguresAreThoseOfTheTree) {
    const TestMesh mesh = accel_test::randomSoup(2000, 0.05f, kSeed);
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    const BvhConfig config{.maxLeafSize = 1, .traversalCost = 2.0f};
    const Bvh bvh = buildBvh("binned", {bounds, mesh.positions, mesh.triangles}, config);
    const double epo = measureEpo(bvh, mesh.positions, mesh.triangles, config);
    for (const LayoutInfo& layout : layouts()) {
        const BvhReport report =
            measureBvh(oneMesh(mesh), {.layout = std::string(layout.name), .bvh = config}, BvhDetail::full);
        EXPECT_NEAR(report.sah, measureQuality(bvh, config).sah, 1e-9 * report.sah) << layout.name;
        EXPECT_NEAR(report.epo.value_or(-1.0), epo, 1e-9) << layout.name;
        EXPECT_EQ(report.nodes, bvh.nodes.size());
        EXPECT_EQ(report.depth, static_cast<int>(bvh.depth));
        EXPECT_TRUE(report.flattenMs.has_value());
        EXPECT_GE(report.bytes(), 2000u * 36u) << layout.name;
    }
}

TEST(BvhReport, CombinedSahIsTheSameForEveryOrderOfInstances) {
    const Scene scene = instances();
    TraceConfig config{.bvh = {.maxLeafSize = 1}, .flattenLimit = 0};
    config.layout = "bvh2";
    const BvhReport first = measureBvh(scene, config, BvhDetail::quick);
    EXPECT_EQ(first.trees, 2u);
    EXPECT_FALSE(first.epo.has_value());
    for (const char* layout : {"bvh4q", "bvh8q", "bvh4b"}) {
        config.layout = layout;
        EXPECT_NEAR(measureBvh(scene, config, BvhDetail::quick).sah, first.sah, 1e-9 * first.sah) << layout;
    }
}

TEST(BvhReport, DuplicatesAndSkippedTrianglesAreCounted) {
    TestMesh mesh = accel_test::randomSlivers(2000, kSeed);
    mesh.add(glm::vec3(0.5f), glm::vec3(0.5f), glm::vec3(0.5f));
    for (const char* builder : {"binned", "spatial"}) {
        const BvhReport report = measureBvh(oneMesh(mesh), {.builder = builder, .layout = "bvh2"}, BvhDetail::full);
        const std::vector<uint32_t>& sizes = report.largest.leafSizeHistogram;
        const std::vector<uint32_t>& depths = report.largest.depthHistogram;
        size_t listed = 0;
        for (size_t size = 0; size < sizes.size(); ++size) listed += size * sizes[size];
        EXPECT_EQ(std::accumulate(depths.begin(), depths.end(), size_t{0}), report.largest.leaves) << builder;
        EXPECT_EQ(listed + report.skipped, mesh.triangles.size() + report.duplicates) << builder;
        EXPECT_EQ(report.duplicates > 0, std::string(builder) == "spatial");
        EXPECT_GE(report.epo.value_or(-1.0), 0.0) << builder;
    }
}

TEST(BvhReport, ASceneThatNoRayHitsHasATreeOfNothing) {
    const BvhReport report = measureBvh(Scene{}, {}, BvhDetail::full);
    EXPECT_EQ(report.trees, 0u);
    EXPECT_EQ(report.sah, 0.0);
    EXPECT_FALSE(report.epo.has_value());
}

}  // namespace
}  // namespace raylab
