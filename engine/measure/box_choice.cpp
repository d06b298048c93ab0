#include "engine/measure/box_choice.h"

#include <algorithm>
#include <queue>

namespace raylab {
namespace {

/// A search opens no more nodes than this: a second at most, whatever the scene.
constexpr size_t kMostOpened = size_t{1} << 20;
constexpr size_t kOpenedBetweenLooks = 1024;  ///< at `cancel`

/// Projects the corners of a box as far as they are before the camera.
struct Silhouette {
    glm::vec2 lo{1e30f}, hi{-1e30f};
    int before = 0;

    void add(const glm::vec3& p) {
        if (!(p.z > 0.0f)) return;
        ++before;
        const glm::vec2 at(p.x / p.z, p.y / p.z);
        lo = glm::min(lo, at);
        hi = glm::max(hi, at);
    }

    /// Within the picture, in parts of its area.
    double area() const {
        const glm::vec2 size = glm::clamp(hi, -1.0f, 1.0f) - glm::clamp(lo, -1.0f, 1.0f);
        if (lo.x > 1.0f || lo.y > 1.0f || hi.x < -1.0f || hi.y < -1.0f) return 0.0;
        constexpr float kThin = 1e-6f;  // a flat box seen from its side is in view too
        return static_cast<double>(std::max(size.x, kThin)) * static_cast<double>(std::max(size.y, kThin)) / 4.0;
    }
};

struct Candidate {
    double area;
    TreeNode at;
    bool operator<(const Candidate& other) const { return area < other.area; }
};

}  // namespace

double areaInView(const TreeInspection& trees, const TreeNode& at, const BoxView& view) {
    const Aabb& box = trees.node(at).bounds;
    const glm::mat4 m = trees.toWorld(at);
    const glm::mat4 rows = glm::transpose(glm::mat4(view.x, view.y, view.w, glm::vec4(0.0f))) * m;
    const glm::vec3 size = box.extent(), start(rows * glm::vec4(box.lo, 1.0f));
    const glm::vec3 alongX = size.x * glm::vec3(rows[0]), alongY = size.y * glm::vec3(rows[1]),
                    alongZ = size.z * glm::vec3(rows[2]);
    Silhouette shape;
    for (int i = 0; i < 8; ++i)
        shape.add(start + ((i & 1) != 0 ? alongX : glm::vec3(0.0f)) + ((i & 2) != 0 ? alongY : glm::vec3(0.0f)) +
                  ((i & 4) != 0 ? alongZ : glm::vec3(0.0f)));
    if (shape.before == 0) return 0.0;
    return shape.before < 8 ? 1.0 : shape.area();
}

std::vector<TreeNode> largestInView(const TreeInspection& trees, const BoxFilter& filter, const BoxView& view,
                                    size_t limit, const std::atomic<bool>* cancel) {
    std::vector<TreeNode> found;
    if (trees.empty()) return found;
    std::priority_queue<Candidate> open;
    open.push({1.0, trees.root()});
    for (size_t opened = 0; !open.empty() && found.size() < limit && opened < kMostOpened; ++opened) {
        if (cancel != nullptr && opened % kOpenedBetweenLooks == 0 && *cancel) throw Cancelled();
        const Candidate next = open.top();
        open.pop();
        const uint32_t depth = trees.depth(next.at);
        const bool isWanted = depth >= filter.depthMin && (!filter.leavesOnly || trees.isLeaf(next.at));
        if (isWanted && depth <= filter.depthMax && areaInView(trees, next.at, view) > 0.0) found.push_back(next.at);
        if (depth >= filter.depthMax) continue;
        for (const TreeNode& child : trees.children(next.at)) {
            const double area = std::min(areaInView(trees, child, view), next.area);
            if (area > 0.0) open.push({area, child});
        }
    }
    return found;
}

std::vector<TreeNode> pathTo(const TreeInspection& trees, const TreeNode& at) {
    std::vector<TreeNode> path;
    const auto climb = [&](TreeNode from) {
        for (path.push_back(from); trees.fact(from).parent != kNoNode; path.push_back(from))
            from.node = trees.fact(from).parent;
    };
    climb(at);
    if (at.tree != kUpperTree)
        for (uint32_t i = 0; i < trees.data.upper.nodes.size(); ++i) {
            const BvhNode& node = trees.data.upper.nodes[i];
            if (at.placement >= node.first && at.placement < node.first + node.count) climb({kUpperTree, i, 0});
        }
    std::ranges::reverse(path);
    return path;
}

}  // namespace raylab
