#include "engine/measure/tree_export.h"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

namespace raylab {
namespace {

using nlohmann::ordered_json;

template <class T>
void appendNumber(std::string& line, T value) {
    std::array<char, 32> text{};
    const auto [end, code] = std::to_chars(text.data(), text.data() + text.size(), value);
    line += ',';
    line.append(text.data(), end);
}

std::string treeName(uint32_t tree) { return tree == kUpperTree ? "upper" : std::to_string(tree); }

std::string nodeLine(const TreeInspection& trees, uint32_t tree, uint32_t index) {
    const BvhNode& node = trees.bvh(tree).nodes[index];
    const NodeFacts& fact = trees.factsOf(tree)[index];
    std::string line = treeName(tree);
    appendNumber(line, index);
    line += fact.parent == kNoNode ? "," : "," + std::to_string(fact.parent);
    line += node.isLeaf() ? "," : "," + std::to_string(node.left);
    appendNumber(line, fact.depth);
    line += node.isLeaf() ? ",1" : ",0";
    appendNumber(line, fact.primitives);
    appendNumber(line, fact.firstSlot);
    appendNumber(line, fact.sahShare);
    appendNumber(line, fact.siblingOverlap);
    for (const glm::vec3& corner : {node.bounds.lo, node.bounds.hi})
        for (int axis = 0; axis < 3; ++axis) appendNumber(line, corner[axis]);
    return line + "\n";
}

ordered_json vectorJson(const glm::vec3& v) { return {v.x, v.y, v.z}; }

ordered_json nodeJson(const TreeInspection& trees, const TreeNode& at) {
    ordered_json json = {{"tree", treeName(at.tree)}, {"node", at.node}};
    const uint32_t instance = trees.instance(at);
    if (instance != shared::kInheritInstance) json["instance"] = instance;
    return json;
}

ordered_json boxJson(const TreeInspection& trees, const BoxTest& test) {
    ordered_json json = nodeJson(trees, test.at);
    const Aabb& box = trees.node(test.at).bounds;
    json["lo"] = vectorJson(box.lo);
    json["hi"] = vectorJson(box.hi);
    json["tNear"] = test.tNear;
    json["tFar"] = test.tFar;
    json["hit"] = test.hit;
    return json;
}

ordered_json primitiveJson(const PrimitiveTest& test) {
    ordered_json json = {{"kind", test.isQuadric ? "quadric" : "triangle"},
                         {"instance", test.instance},
                         {"primitive", test.primitive},
                         {"hit", test.hit}};
    if (test.hit) json.update({{"t", test.t}, {"u", test.u}, {"v", test.v}});
    return json;
}

ordered_json stepJson(const TreeInspection& trees, const WalkStep& step) {
    constexpr std::array kKinds = {"inner", "instance", "leaf"};
    ordered_json json = {{"kind", kKinds[static_cast<size_t>(step.kind)]}, {"at", nodeJson(trees, step.at)}};
    for (const BoxTest& box : step.boxes) json["boxes"].push_back(boxJson(trees, box));
    for (const PrimitiveTest& test : step.primitives) json["primitives"].push_back(primitiveJson(test));
    json["stack"] = ordered_json::array();
    for (const TreeNode& at : step.stack) json["stack"].push_back(nodeJson(trees, at));
    json["tBest"] = step.tBest;
    return json;
}

}  // namespace

std::string nodeListCsv(const TreeInspection& trees) {
    std::string text =
        "tree,node,parent,left,depth,leaf,primitives,first_slot,sah_share,sibling_overlap,lo_x,lo_y,lo_z,hi_x,hi_y,hi_"
        "z\n";
    for (uint32_t i = 0; i < trees.upperFacts.size(); ++i) text += nodeLine(trees, kUpperTree, i);
    for (uint32_t tree = 0; tree < trees.facts.size(); ++tree)
        for (uint32_t i = 0; i < trees.facts[tree].size(); ++i) text += nodeLine(trees, tree, i);
    return text;
}

std::string walkJson(const TreeInspection& trees, const RayWalk& walk) {
    ordered_json json = {{"schema", "raylab.ray-walk/1"},
                         {"ray",
                          {{"origin", vectorJson(walk.ray.origin)},
                           {"direction", vectorJson(walk.ray.direction)},
                           {"tMin", walk.ray.tMin},
                           {"tMax", walk.ray.tMax}}},
                         {"steps", ordered_json::array()}};
    for (const WalkStep& step : walk.steps) json["steps"].push_back(stepJson(trees, step));
    json["hit"] = nullptr;
    if (walk.hit) {
        json["hit"] = primitiveJson(*walk.hit);
        json["hit"]["normal"] = vectorJson(walk.normal);
    }
    return json.dump(1) + "\n";
}

}  // namespace raylab
