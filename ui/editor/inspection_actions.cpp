#include "ui/editor/inspection_actions.h"

#include <algorithm>

#include "ui/editor/heat_map.h"
#include "ui/editor/ray_stepper.h"

namespace raylab {
namespace {

std::map<std::string, double> treeNumbers(const BvhState& state) {
    const SceneBuild& build = state.builds[state.shown];
    const TreeInspection* trees = build.trees.get();
    std::map<std::string, double> numbers = {
        {"bvh-busy", build.isBuilding || (state.showBoxes && state.list.trees != build.trees) ? 1.0 : 0.0},
        {"bvh-boxes", state.showBoxes ? static_cast<double>(state.list.boxes.size()) : 0.0},
        {"bvh-boxes-wanted", static_cast<double>(state.list.wanted)},
        {"bvh-sah", trees != nullptr ? trees->sah : 0.0},
        {"bvh-nodes", 0.0},
        {"bvh-epo", -1.0},
        {"bvh-b-sah", state.builds[1].trees != nullptr ? state.builds[1].trees->sah : 0.0},
        {"bvh-selected", state.selected ? static_cast<double>(state.selectedIn->depth(*state.selected)) : -1.0},
        {"bvh-selected-leaf", state.selected && state.selectedIn->isLeaf(*state.selected) ? 1.0 : 0.0}};
    if (trees == nullptr || trees->data.trees.empty()) return numbers;
    const auto largest = std::ranges::max_element(trees->data.trees, {}, &PrimitiveTree::slotCount);
    numbers["bvh-nodes"] = static_cast<double>(largest->bvh.nodes.size());
    numbers["bvh-epo"] = build.epo[static_cast<size_t>(largest - trees->data.trees.begin())].value_or(-1.0);
    return numbers;
}

std::map<std::string, double> rayNumbers(const RaySteps& ray) {
    std::map<std::string, double> numbers = {{"ray-bounces", static_cast<double>(ray.bounces.size())},
                                             {"ray-step", static_cast<double>(ray.step)}};
    const WalkStep none;
    const bool has = !ray.bounces.empty() && !ray.walk().steps.empty();
    const WalkStep& step = has ? ray.walk().steps[ray.step] : none;
    numbers["ray-steps"] = has ? static_cast<double>(ray.walk().steps.size()) : 0.0;
    numbers["ray-stack"] = static_cast<double>(step.stack.size());
    numbers["ray-tested"] = static_cast<double>(step.primitives.size());
    numbers["ray-hit"] = has && ray.walk().hit ? 1.0 : 0.0;
    return numbers;
}

std::map<std::string, double> countNumbers(const HeatState& heat) {
    const auto& counts = heat.shown;
    return {{"counts-busy", heat.counter.isBusy() ? 1.0 : 0.0},
            {"counts-rays", counts ? static_cast<double>(counts->bounces[heat.shownBounce].counts.size()) : 0.0},
            {"counts-mean", heat.summary.mean},
            {"counts-most", heat.summary.most},
            {"counts-low", heat.lo},
            {"counts-high", heat.hi}};
}

}  // namespace

void toggleBoxes(EditorContext& context) {
    auto& state = context.states.get<BvhState>();
    state.showBoxes = !state.showBoxes;
    if (!state.showBoxes) state.selected.reset();
}

bool showsBoxes(const EditorContext& context) { return context.states.get<BvhState>().showBoxes; }

void toggleCounts(EditorContext& context) {
    auto& heat = context.states.get<HeatState>();
    heat.show = !heat.show;
}

bool showsCounts(const EditorContext& context) { return context.states.get<HeatState>().show; }

void startPicking(EditorContext& context) {
    context.states.get<BvhState>().ray.picks = true;
    context.layoutRequest = "Ray";
}

void stepForward(EditorContext& context) { stepRay(context.states.get<BvhState>().ray, 1); }

void stepBack(EditorContext& context) { stepRay(context.states.get<BvhState>().ray, -1); }

bool hasRay(const EditorContext& context) { return !context.states.get<BvhState>().ray.bounces.empty(); }

uint32_t countingValidationMessages(const EditorContext& context) {
    return context.states.get<HeatState>().counter.validationMessages();
}

std::map<std::string, double> inspectionNumbers(const EditorContext& context) {
    std::map<std::string, double> numbers = treeNumbers(context.states.get<BvhState>());
    numbers.merge(rayNumbers(context.states.get<BvhState>().ray));
    numbers.merge(countNumbers(context.states.get<HeatState>()));
    return numbers;
}

}  // namespace raylab
