#pragma once

#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "engine/measure/box_choice.h"
#include "ui/editor/bvh_builds.h"
#include "ui/editor/context.h"
#include "ui/editor/model/color_map.h"

namespace raylab {

/// What the colours of boxes mean.
enum class BoxColor { depth, sahCost, siblingOverlap, primitives, instance };

/// Boxes at most that are drawn: a line list that costs ImGui some milliseconds.
constexpr size_t kMostBoxes = 1500;

/// The boxes that are drawn; they follow filter, view and trees with a little delay.
struct BoxList {
    std::vector<TreeNode> boxes;                  ///< the largest in view first
    size_t wanted = 0;                            ///< that the filter lets through, in view or not
    std::shared_ptr<const TreeInspection> trees;  ///< that `boxes` are of
    BoxFilter filter;
    Camera camera;
    float aspect = 0.0f;
    bool isChoosing = false;
};

/// A ray that is walked, and its bounces.
struct RaySteps {
    std::shared_ptr<const TreeInspection> trees;  ///< that it was walked through
    std::vector<RayWalk> bounces;                 ///< empty: no ray has been picked
    size_t bounce = 0;                            ///< of bounces
    size_t step = 0;                              ///< of its steps
    size_t scrolledTo = 0;                        ///< step that the list was last scrolled to
    bool picks = false;                           ///< the next click in the viewport chooses a ray
    std::mt19937 random{1};                       ///< of diffuse bounces

    const RayWalk& walk() const { return bounces[bounce]; }
};

/// What the panels about trees and the overlay share.
struct BvhState {
    BvhBuilds builds;
    size_t shown = 0;       ///< which of the builds
    bool compares = false;  ///< the second build is wanted
    std::optional<TraceConfig>
        second;              ///< of which builder, layout and maxLeafSize are its own, the rest the settings'
    int wantedInFrame = -1;  ///< ImGui's number of the last frame in which a panel looked at the trees

    bool showBoxes = false;
    BoxFilter filter{0, 5, false};
    BoxColor color = BoxColor::depth;
    editor::ColorMap map = editor::ColorMap::sequential;
    BoxList list;
    Camera measuredView;  ///< of the rays that both builds are measured by
    float measuredAspect = 0.0f;

    std::shared_ptr<const TreeInspection> selectedIn;  ///< the trees that `selected` is of
    std::optional<TreeNode> selected;
    bool revealSelected = false;  ///< the tree view opens its branch, and scrolls there
    uint32_t chosenTree = 0;      ///< whose figures and nodes are listed
    RaySteps ray;

    /// Of the shown build; nullptr before it has been built.
    const TreeInspection* trees() const { return builds[shown].trees.get(); }
    void select(const TreeNode& at, bool reveal) {
        selected = at;
        selectedIn = builds[shown].trees;
        revealSelected = reveal;
    }
};

}  // namespace raylab
