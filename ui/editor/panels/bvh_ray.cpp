#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "ui/editor/bvh_overlay.h"
#include "ui/editor/inspection_panels.h"
#include "ui/editor/panel_parts.h"
#include "ui/editor/panels/bvh.h"
#include "ui/editor/ray_stepper.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

std::string vectorText(const glm::vec3& v) {
    char text[80];
    std::snprintf(text, sizeof(text), "%.4g  %.4g  %.4g", static_cast<double>(v.x), static_cast<double>(v.y),
                  static_cast<double>(v.z));
    return text;
}

std::string placeText(const TreeInspection& trees, const TreeNode& at) {
    const std::string name = nodeName(trees, at);
    if (at.tree == kUpperTree) return name;
    const uint32_t instance = trees.instance(at);
    return instance == shared::kInheritInstance ? name : name + " of instance " + std::to_string(instance);
}

std::string distanceText(float t) { return figureText(static_cast<double>(t)); }

/// What a step does, in a line.
std::string stepText(const TreeInspection& trees, const WalkStep& step) {
    const std::string place = placeText(trees, step.at);
    if (step.kind == WalkKind::instance) return place + ": into its space";
    if (step.kind == WalkKind::leaf) {
        const auto hits = std::ranges::count_if(step.primitives, &PrimitiveTest::hit);
        return place + ": " + std::to_string(step.primitives.size()) + " tested, " + std::to_string(hits) + " hit";
    }
    const auto hits = std::ranges::count_if(step.boxes, &BoxTest::hit);
    return place + ": " + std::to_string(hits) + " of " + std::to_string(step.boxes.size()) + " boxes hit";
}

void drawSteps(RaySteps& ray) {
    const std::vector<WalkStep>& steps = ray.walk().steps;
    ImGui::BeginChild("steps", {ImGui::GetContentRegionAvail().x * 0.42f, 0.0f}, true);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(steps.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const auto index = static_cast<size_t>(i);
            ImGui::PushID(i);
            const std::string text = std::to_string(i + 1) + "  " + stepText(*ray.trees, steps[index]);
            if (ImGui::Selectable(text.c_str(), index == ray.step)) ray.step = index;
            ImGui::PopID();
        }
    if (ray.scrolledTo != ray.step) {
        const float line = ImGui::GetTextLineHeightWithSpacing();
        ImGui::SetScrollY(
            std::max((static_cast<float>(ray.step) + 0.5f) * line - 0.5f * ImGui::GetWindowHeight(), 0.0f));
        ray.scrolledTo = ray.step;
    }
    ImGui::EndChild();
}

void drawTests(const TreeInspection& trees, const WalkStep& step) {
    for (const BoxTest& test : step.boxes) {
        const std::string name = nodeName(trees, test.at);
        if (test.hit)
            ImGui::TextColored(color::kGood, "%s: t %s to %s", name.c_str(), distanceText(test.tNear).c_str(),
                               distanceText(test.tFar).c_str());
        else
            ImGui::TextColored(color::kError, "%s: %s", name.c_str(),
                               test.tFar < test.tNear ? "missed" : "behind the closest hit");
    }
    for (const PrimitiveTest& test : step.primitives) {
        const char* kind = test.isQuadric ? "quadric" : "triangle";
        if (test.hit)
            ImGui::TextColored(color::kGood, "%s %u of instance %u: t %s", kind, test.primitive, test.instance,
                               distanceText(test.t).c_str());
        else
            ImGui::TextColored(color::kWarning, "%s %u of instance %u: no", kind, test.primitive, test.instance);
    }
}

void drawStack(const TreeInspection& trees, const WalkStep& step) {
    if (step.stack.empty())
        ImGui::TextColored(color::kDim, "the stack is empty");
    else
        ImGui::TextColored(color::kDim, "stack of %zu, the top first", step.stack.size());
    for (auto at = step.stack.rbegin(); at != step.stack.rend(); ++at)
        ImGui::TextUnformatted(placeText(trees, *at).c_str());
}

void drawStepDetails(const RaySteps& ray) {
    const WalkStep& step = ray.walk().steps[ray.step];
    ImGui::SameLine();
    ImGui::BeginChild("tests", {ImGui::GetContentRegionAvail().x * 0.55f, 0.0f}, true);
    ImGui::TextColored(color::kSelection, "%s", placeText(*ray.trees, step.at).c_str());
    drawTests(*ray.trees, step);
    ImGui::TextColored(color::kDim, step.tBest < 1e30f ? "closest hit so far: t %s" : "nothing hit so far",
                       distanceText(step.tBest).c_str());
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("stack", {0.0f, 0.0f}, true);
    drawStack(*ray.trees, step);
    ImGui::EndChild();
}

/// Which of the rays, and where it ends.
void drawBounces(RaySteps& ray) {
    const auto name = [](size_t i) { return i == 0 ? std::string("view ray") : "bounce " + std::to_string(i); };
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 6.5f);
    if (ImGui::BeginCombo("##bounce", name(ray.bounce).c_str())) {
        for (size_t i = 0; i < ray.bounces.size(); ++i)
            if (ImGui::Selectable(name(i).c_str(), ray.bounce == i)) {
                ray.bounce = i;
                ray.step = 0;
            }
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    const RayWalk& walk = ray.walk();
    const std::string end = walk.hit ? "hits at t " + distanceText(walk.hit->t) : "misses";
    ImGui::TextColored(color::kDim, "%s", end.c_str());
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("from %s\nto %s", vectorText(walk.ray.origin).c_str(),
                          vectorText(walk.ray.direction).c_str());
}

void drawBounceButtons(RaySteps& ray) {
    ImGui::SameLine();
    ImGui::BeginDisabled(!ray.walk().hit.has_value());
    if (ImGui::Button("Mirror")) bounceRay(ray, BounceKind::mirror);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("The next ray: mirrored about the normal");
    ImGui::SameLine();
    if (ImGui::Button("Diffuse")) bounceRay(ray, BounceKind::diffuse);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("The next ray: a random diffuse bounce");
    ImGui::EndDisabled();
}

void drawStepButtons(RaySteps& ray) {
    const auto last = static_cast<int>(ray.walk().steps.size());
    int shown = static_cast<int>(ray.step) + 1;
    ImGui::SameLine();
    if (ImGui::ArrowButton("back", ImGuiDir_Left)) stepRay(ray, -1);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9.0f);
    if (ImGui::SliderInt("##step", &shown, 1, std::max(last, 1), ("step %d of " + std::to_string(last)).c_str(),
                         ImGuiSliderFlags_AlwaysClamp))
        ray.step = static_cast<size_t>(shown - 1);
    ImGui::SameLine();
    if (ImGui::ArrowButton("on", ImGuiDir_Right)) stepRay(ray, 1);
}

}  // namespace

/// The walk of one ray, step by step.
void drawRayPanel(EditorContext& context) {
    lookAtTrees(context);
    auto& state = context.states.get<BvhState>();
    RaySteps& ray = state.ray;
    if (ImGui::Button(ray.picks ? "Click in the picture ..." : "Pick a ray")) ray.picks = !ray.picks;
    if (ray.bounces.empty()) {
        dimText(
            "Walks a ray through the trees, node by node: R, or the button, then a click in the picture. "
            "Left and Right step.");
        return;
    }
    drawStepButtons(ray);
    drawBounceButtons(ray);
    ImGui::SameLine();
    if (ImGui::Button("Export")) exportWalk(context);
    ImGui::SameLine();
    if (ImGui::Button("Clear")) {
        ray.bounces.clear();
        return;
    }
    ImGui::SameLine();
    drawBounces(ray);
    if (ray.walk().steps.empty()) return;
    drawSteps(ray);
    drawStepDetails(ray);
}

}  // namespace raylab
