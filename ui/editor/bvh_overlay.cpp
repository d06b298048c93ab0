#include "ui/editor/bvh_overlay.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ui/editor/camera_control.h"
#include "ui/editor/line_painter.h"
#include "ui/editor/ray_stepper.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

using editor::mapColor;

constexpr float kFar = 2.0f;         ///< a ray that misses is drawn so far, in distances of the camera to its target
constexpr float kStaleAlpha = 0.3f;  ///< of boxes of a scene that was
constexpr uint32_t kViewRaysX = 40, kViewRaysY = 24;

uint32_t packed(const glm::vec3& color, float alpha) {
    return ImGui::GetColorU32(ImVec4(color.x, color.y, color.z, alpha));
}

void drawNode(const TreeInspection& trees, const TreeNode& at, const LinePainter& painter, uint32_t color,
              float width) {
    const Aabb& box = trees.node(at).bounds;
    painter.box({box.lo, box.hi}, trees.toWorld(at), color, width);
}

bool isStale(const BvhState& state) { return state.builds[state.shown].isBuilding; }

/// Grey where a node holds several: in the upper tree, and above the leaves of merged meshes.
glm::vec3 instanceColor(const TreeInspection& trees, const TreeNode& at) {
    uint32_t instance = trees.instance(at);
    if (instance == shared::kInheritInstance && trees.isLeaf(at)) {
        const uint32_t slot = trees.data.trees[at.tree].firstSlot + trees.fact(at).firstSlot;
        instance = trees.data.triangles[slot].instance & shared::kInstanceMask;
    }
    return instance == shared::kInheritInstance ? glm::vec3(0.6f) : editor::categoryColor(instance);
}

BoxView boxView(const EditorContext& context) {
    const Camera& camera = context.state.camera;
    const CameraAxes axes = cameraAxes(camera);
    const float slope = std::tan(0.5f * camera.fovYRadians);
    const auto row = [&](const glm::vec3& axis, float scale) {
        return glm::vec4(axis, -glm::dot(axis, camera.position)) / scale;
    };
    return {row(axes.right, slope * context.view.aspect()), row(axes.up, slope), row(axes.ahead, 1.0f)};
}

bool isUpToDate(const EditorContext& context, const BvhState& state) {
    const BoxList& list = state.list;
    return list.trees == state.builds[state.shown].trees && list.filter == state.filter &&
           list.camera == context.state.camera && list.aspect == context.view.aspect();
}

/// Chooses the boxes anew in the background, one choice at a time.
void keepBoxes(EditorContext& context, BvhState& state) {
    if (!state.showBoxes || state.trees() == nullptr || state.list.isChoosing || isUpToDate(context, state)) return;
    BoxList next;
    next.trees = state.builds[state.shown].trees;
    next.filter = state.filter;
    next.camera = context.state.camera;
    next.aspect = context.view.aspect();
    state.list.isChoosing = true;
    state.builds.quick().start("Choosing boxes", [&state, next, view = boxView(context)](JobControl&) mutable {
        next.wanted = countBoxes(*next.trees, next.filter);
        next.boxes = largestInView(*next.trees, next.filter, view, kMostBoxes);
        return Background::Finish([&state, next = std::move(next)]() mutable { state.list = std::move(next); });
    });
}

/// Rays of a coarse grid over the picture, once the view rests: what a build costs for them.
void keepViewRays(EditorContext& context, BvhState& state) {
    const bool isSame = state.measuredView == context.state.camera && state.measuredAspect == context.view.aspect();
    if (!state.compares || isSame || context.viewMoves) return;
    state.measuredView = context.state.camera;
    state.measuredAspect = context.view.aspect();
    std::vector<WalkRay> rays;
    for (uint32_t y = 0; y < kViewRaysY; ++y)
        for (uint32_t x = 0; x < kViewRaysX; ++x)
            rays.push_back(rayThroughView(context, (static_cast<float>(x) + 0.5f) / kViewRaysX,
                                          (static_cast<float>(y) + 0.5f) / kViewRaysY));
    state.builds.measureView(std::move(rays));
}

TraceConfig secondConfig(const BvhState& state, TraceConfig config) {
    config.builder = state.second->builder;
    config.layout = state.second->layout;
    config.bvh.maxLeafSize = state.second->bvh.maxLeafSize;
    return config;
}

void drawBoxes(const BvhState& state, const LinePainter& painter) {
    const float alpha = isStale(state) ? kStaleAlpha : 0.8f;
    const TreeInspection& trees = *state.list.trees;
    for (auto at = state.list.boxes.rbegin(); at != state.list.boxes.rend(); ++at)  // the large ones on top
        drawNode(trees, *at, painter, packed(boxColor(state, trees, *at), alpha), 1.0f);
}

void drawStep(const EditorContext& context, const RaySteps& ray, const LinePainter& painter) {
    const TreeInspection& trees = *ray.trees;
    const WalkStep& step = ray.walk().steps[ray.step];
    for (const TreeNode& at : step.stack) drawNode(trees, at, painter, packed({0.62f, 0.62f, 0.68f}, 0.6f), 1.0f);
    for (const BoxTest& test : step.boxes)
        drawNode(trees, test.at, painter, ImGui::GetColorU32(test.hit ? color::kGood : color::kError), 1.5f);
    drawNode(trees, step.at, painter, ImGui::GetColorU32(color::kSelection), 2.0f);
    const glm::mat4 m = trees.toWorld(step.at);
    for (const PrimitiveTest& test : step.primitives) {
        if (test.isQuadric) continue;
        const shared::TraceTriangle& t = trees.data.triangles[test.slot];
        const ImVec4& ink = test.hit ? color::kGood : color::kWarning;
        painter.triangle({glm::vec3(m * glm::vec4(t.p0, 1.0f)), glm::vec3(m * glm::vec4(t.p1, 1.0f)),
                          glm::vec3(m * glm::vec4(t.p2, 1.0f))},
                         ImGui::GetColorU32(ink), packed({ink.x, ink.y, ink.z}, 0.3f), 1.5f * context.scale);
    }
}

/// All bounces so far; the one that is stepped through is bright.
void drawRay(const EditorContext& context, const RaySteps& ray, const LinePainter& painter) {
    const float reach = kFar * glm::distance(context.state.camera.position, context.state.camera.target);
    for (size_t i = 0; i < ray.bounces.size(); ++i) {
        const RayWalk& walk = ray.bounces[i];
        const float end = walk.hit ? walk.hit->t : reach / glm::length(walk.ray.direction);
        const glm::vec3 to = walk.ray.origin + end * walk.ray.direction;
        const uint32_t ink =
            packed({color::kAccent.x, color::kAccent.y, color::kAccent.z}, i == ray.bounce ? 1.0f : 0.5f);
        painter.line(walk.ray.origin, to, ink, 2.0f);
        if (walk.hit) painter.mark(to, ink, 6.0f * context.scale);
    }
    if (!ray.walk().steps.empty()) drawStep(context, ray, painter);
}

}  // namespace

void lookAtTrees(EditorContext& context) { context.states.get<BvhState>().wantedInFrame = ImGui::GetFrameCount(); }

void keepTrees(EditorContext& context) {
    auto& state = context.states.get<BvhState>();
    state.builds.collect();
    const bool isWanted = state.showBoxes || state.ray.picks || !state.ray.bounces.empty() ||
                          state.wantedInFrame + 1 >= ImGui::GetFrameCount();
    if (!context.state.hasScene() || !isWanted) return;
    const auto scene = context.state.document->rendered();
    const TraceConfig config = traceConfig(context.state.settings(), *scene);
    state.builds.want(0, scene, config);
    if (state.compares) state.builds.want(1, scene, secondConfig(state, config));
    if (state.selected && state.selectedIn != state.builds[state.shown].trees) state.selected.reset();
    keepBoxes(context, state);
    keepViewRays(context, state);
    keepRay(state);
}

void drawBvhOverlay(EditorContext& context) {
    const auto& state = context.states.get<BvhState>();
    const bool hasBoxes = state.showBoxes && state.list.trees != nullptr;
    if (!hasBoxes && !state.selected && state.ray.bounces.empty()) return;
    const ViewRectangle& r = context.view;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({r.x, r.y}, {r.x + r.width, r.y + r.height}, true);
    const LinePainter painter(context);
    if (hasBoxes) drawBoxes(state, painter);
    if (state.selected)
        drawNode(*state.selectedIn, *state.selected, painter, ImGui::GetColorU32(color::kSelection), 2.5f);
    if (!state.ray.bounces.empty()) drawRay(context, state.ray, painter);
    list.PopClipRect();
}

WalkRay rayThroughView(const EditorContext& context, float x, float y) {
    const Camera& camera = context.state.camera;
    const CameraAxes axes = cameraAxes(camera);
    const float slope = std::tan(0.5f * camera.fovYRadians), aspect = context.view.aspect();
    const glm::vec3 way =
        axes.ahead + (2.0f * x - 1.0f) * slope * aspect * axes.right + (1.0f - 2.0f * y) * slope * axes.up;
    return {camera.position, glm::normalize(way)};
}

bool takeBvhClick(EditorContext& context, float x, float y) {
    auto& state = context.states.get<BvhState>();
    if (state.trees() == nullptr || !(state.ray.picks || state.showBoxes)) return state.ray.picks;
    const RayWalk walk = walkRay(*state.trees(), rayThroughView(context, x, y));
    state.selected.reset();
    if (const auto leaf = leafOfHit(walk)) state.select(*leaf, true);
    if (std::exchange(state.ray.picks, false)) startRay(state, walk);
    return true;
}

std::optional<Bounds> selectedNodeBox(EditorContext& context) {
    const auto& state = context.states.get<BvhState>();
    if (!state.selected) return {};
    const Aabb box = worldBox(*state.selectedIn, *state.selected);
    return Bounds{box.lo, box.hi};
}

glm::vec3 boxColor(const BvhState& state, const TreeInspection& trees, const TreeNode& at) {
    const NodeFacts& fact = trees.fact(at);
    switch (state.color) {
        case BoxColor::depth: {
            const uint32_t lo = state.list.filter.depthMin, hi = std::max(state.list.filter.depthMax, lo + 1);
            return mapColor(state.map,
                            static_cast<double>(trees.depth(at) - std::min(lo, trees.depth(at))) / (hi - lo));
        }
        case BoxColor::sahCost:
            return mapColor(state.map, 1.0 + std::log10(std::max(fact.sahShare, 1e-9)) / 5.0);
        case BoxColor::siblingOverlap:
            return mapColor(state.map, fact.siblingOverlap);
        case BoxColor::primitives:
            return mapColor(state.map, std::log2(std::max(static_cast<double>(fact.primitives), 1.0)) / 20.0);
        case BoxColor::instance:
            return instanceColor(trees, at);
    }
    return glm::vec3(1.0f);
}

}  // namespace raylab
