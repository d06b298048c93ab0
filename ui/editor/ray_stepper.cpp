#include "ui/editor/ray_stepper.h"

#include <algorithm>
#include <filesystem>
#include <span>

#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/measure/tree_export.h"
#include "ui/editor/free_name.h"

namespace raylab {
namespace {

void writeText(EditorContext& context, const std::filesystem::path& path, std::function<std::string()> text) {
    context.background.start("Writing " + path.string(), [path, text](JobControl&) -> Background::Finish {
        const std::string all = text();
        writeFileAtomically(path, std::as_bytes(std::span(all)));
        logInfo("written: " + std::filesystem::absolute(path).string());
        return [] {};
    });
}

}  // namespace

std::optional<TreeNode> leafOfHit(const RayWalk& walk) {
    std::optional<TreeNode> leaf;
    for (const WalkStep& step : walk.steps)
        for (const PrimitiveTest& test : step.primitives)
            if (test.hit) leaf = step.at;  // the last hit is the closest
    return leaf;
}

void startRay(BvhState& state, RayWalk walk) {
    state.ray.trees = state.builds[state.shown].trees;
    state.ray.bounces = {std::move(walk)};
    state.ray.bounce = state.ray.step = 0;
}

void keepRay(BvhState& state) {
    RaySteps& ray = state.ray;
    const auto trees = state.builds[state.shown].trees;
    if (ray.bounces.empty() || trees == nullptr || ray.trees == trees) return;
    ray.trees = trees;
    for (RayWalk& walk : ray.bounces) walk = walkRay(*trees, walk.ray);
    stepRay(ray, 0);
}

void stepRay(RaySteps& ray, int steps) {
    const auto last = std::max(static_cast<int>(ray.walk().steps.size()) - 1, 0);
    ray.step = static_cast<size_t>(std::clamp(static_cast<int>(ray.step) + steps, 0, last));
}

bool bounceRay(RaySteps& ray, BounceKind kind) {
    std::uniform_real_distribution<float> number(0.0f, 1.0f);
    std::optional<WalkRay> next;
    if (kind == BounceKind::mirror) {
        next = mirrorBounce(ray.walk());
    } else {
        const float u0 = number(ray.random), u1 = number(ray.random);
        next = diffuseBounce(ray.walk(), u0, u1);
    }
    if (!next) return false;
    ray.bounces.resize(ray.bounce + 1);
    ray.bounces.push_back(walkRay(*ray.trees, *next));
    ++ray.bounce;
    ray.step = 0;
    return true;
}

void exportWalk(EditorContext& context) {
    const RaySteps& ray = context.states.get<BvhState>().ray;
    writeText(context, freeFileName("raylab-walk", ".json"),
              [trees = ray.trees, walk = ray.walk()] { return walkJson(*trees, walk); });
}

void exportNodes(EditorContext& context) {
    const auto& state = context.states.get<BvhState>();
    writeText(context, freeFileName("raylab-nodes", ".csv"),
              [trees = state.builds[state.shown].trees] { return nodeListCsv(*trees); });
}

}  // namespace raylab
