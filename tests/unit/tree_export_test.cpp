#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/measure/tree_export.h"
#include "tests/unit/inspection_support.h"

namespace raylab {
namespace {

using namespace inspection_test;

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result;
    std::istringstream stream(line + ",");
    for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
    return result;
}

TEST(TreeExport, ListsEachNodeOnceWithItsParent) {
    const TreeInspection trees = inspectTrees(instanceScene(), kMeshTrees);
    size_t nodes = trees.data.upper.nodes.size();
    for (const PrimitiveTree& tree : trees.data.trees) nodes += tree.bvh.nodes.size();
    std::istringstream stream(nodeListCsv(trees));
    std::string line;
    std::getline(stream, line);
    const size_t columns = cells(line).size();
    size_t lines = 0, roots = 0;
    double share = 0.0;
    for (; std::getline(stream, line); ++lines) {
        const std::vector<std::string> row = cells(line);
        ASSERT_EQ(row.size(), columns) << line;
        roots += row[2].empty() ? 1 : 0;
        share += std::stod(row[8]);
        EXPECT_EQ(row[3].empty(), row[5] == "1") << line;
    }
    EXPECT_EQ(lines, nodes);
    EXPECT_EQ(roots, trees.data.trees.size() + 1);
    EXPECT_NEAR(share, static_cast<double>(roots), 1e-9);
}

TEST(TreeExport, WritesAWalkThatReadsBack) {
    const TreeInspection trees = inspectTrees(instanceScene(), kMeshTrees);
    accel_test::Random random(kSeed + 20);
    RayWalk walk;
    for (int i = 0; i < 200 && !walk.hit; ++i) walk = walkRay(trees, {random.inCube(-2.0f, 2.0f), random.direction()});
    ASSERT_TRUE(walk.hit.has_value());
    const auto json = nlohmann::json::parse(walkJson(trees, walk));
    EXPECT_EQ(json["schema"], "raylab.ray-walk/1");
    ASSERT_EQ(json["steps"].size(), walk.steps.size());
    EXPECT_EQ(json["hit"]["t"].get<float>(), walk.hit->t);
    EXPECT_EQ(json["hit"]["instance"].get<uint32_t>(), walk.hit->instance);
    for (size_t i = 0; i < walk.steps.size(); ++i) {
        EXPECT_EQ(json["steps"][i]["stack"].size(), walk.steps[i].stack.size());
        EXPECT_EQ(json["steps"][i].contains("boxes"), walk.steps[i].kind == WalkKind::inner);
    }
    const RayWalk miss = walkRay(trees, {{100.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}});
    EXPECT_TRUE(nlohmann::json::parse(walkJson(trees, miss))["hit"].is_null());
}

}  // namespace
}  // namespace raylab
