#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/scene/bounds.h"
#include "ui/editor/bvh_overlay.h"
#include "ui/editor/camera_control.h"
#include "ui/editor/compare.h"
#include "ui/editor/compare_view.h"
#include "ui/editor/gizmo_overlay.h"
#include "ui/editor/heat_map.h"
#include "ui/editor/model/edit_instances.h"
#include "ui/editor/panels.h"
#include "ui/editor/scene_actions.h"
#include "ui/editor/theme.h"
#include "ui/editor/view_overlay.h"

namespace raylab {
namespace {

constexpr float kRadiansPerPixel = 0.005f;
constexpr float kFlightShare = 0.12f;  ///< of the scene's diagonal in a second
constexpr float kFast = 5.0f;
constexpr float kTap = 1.0f / 30.0f;  ///< seconds that a tap of a key counts as at least
constexpr float kDollyStep = 0.88f;
constexpr float kClickPixels = 4.0f;

/// What the viewport remembers between frames.
struct ViewportState {
    UiImagePtr image;
    uint64_t shown = 0;           ///< number of the picture in `image`
    uint64_t pickTicket = 0;      ///< of the pick that is awaited
    bool pickSetsPivot = false;
    bool pickAdds = false;  ///< to what is selected
    std::optional<uint32_t> dropped;  ///< material that what is picked will wear
    float speed = 1.0f;           ///< of flight, by the wheel
    double diagonal = 1.0;
    uint64_t measured = ~uint64_t{0};  ///< revision of the document that `diagonal` is of
};

/// The largest rectangle of the settings' aspect within the window, were it so much higher.
ViewRectangle fitPicture(EditorContext& context, float moreHeight) {
    const ImVec2 at = ImGui::GetWindowPos(), window{ImGui::GetWindowWidth(), ImGui::GetWindowHeight() + moreHeight};
    const bool isHalf = context.states.get<Comparison>().mode() == CompareMode::sideBySide;
    const ImVec2 room = {isHalf ? 0.5f * window.x : window.x, window.y};
    const RenderSettings& s = context.state.settings();
    const float aspect = static_cast<float>(s.width) / static_cast<float>(s.height);
    const float width = std::round(std::min(room.x, room.y * aspect)), height = std::round(width / aspect);
    return {std::floor(at.x + 0.5f * (room.x - width)), std::floor(at.y + 0.5f * (room.y - height)), width, height};
}

float flightSpeed(const EditorContext& context, ViewportState& v) {
    if (v.measured != context.state.document->revision()) {
        v.measured = context.state.document->revision();
        const Bounds box = sceneBounds(context.state.scene());
        v.diagonal = glm::length(box.hi - box.lo);
    }
    const bool fast = context.input.down[GLFW_KEY_LEFT_SHIFT] || context.input.down[GLFW_KEY_RIGHT_SHIFT];
    return static_cast<float>(v.diagonal) * kFlightShare * v.speed * (fast ? kFast : 1.0f);
}

/// W A S D, Q and E; not while Ctrl asks for something else.
void flyByKeys(EditorContext& context, ViewportState& v) {
    const Input& input = context.input;
    if (ImGui::GetIO().WantTextInput || input.down[GLFW_KEY_LEFT_CONTROL] || input.down[GLFW_KEY_RIGHT_CONTROL]) return;
    const auto axis = [&](int ahead, int back) { return static_cast<float>(input.held(ahead)) - static_cast<float>(input.held(back)); };
    const glm::vec3 way{axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S)};
    if (way == glm::vec3(0.0f)) return;
    const float seconds = std::max(static_cast<float>(context.seconds), kTap);
    fly(context.state.camera, way * flightSpeed(context, v) * seconds);
    context.viewMoves = true;
}

void moveByPointer(EditorContext& context, ViewportState& v) {
    const ImGuiIO& io = ImGui::GetIO();
    Camera& camera = context.state.camera;
    const float right = io.MouseDelta.x * kRadiansPerPixel, down = io.MouseDelta.y * kRadiansPerPixel;
    const bool orbits = ImGui::IsMouseDown(ImGuiMouseButton_Middle) || (io.KeyAlt && ImGui::IsMouseDown(ImGuiMouseButton_Left));
    const bool looks = ImGui::IsMouseDown(ImGuiMouseButton_Right);
    if (ImGui::IsItemActive() && (right != 0.0f || down != 0.0f)) {
        if (orbits && io.KeyShift) {
            const float unit = glm::distance(camera.position, camera.target) * 0.0015f;
            fly(camera, {-io.MouseDelta.x * unit, io.MouseDelta.y * unit, 0.0f});
        } else if (orbits) {
            orbit(camera, right, down);
        } else if (looks) {
            lookAround(camera, right, -down);
        }
        context.viewMoves = context.viewMoves || orbits || looks;
    }
    if (!ImGui::IsItemHovered() || io.MouseWheel == 0.0f) return;
    if (looks) {
        v.speed = std::clamp(v.speed * std::pow(1.25f, io.MouseWheel), 0.01f, 100.0f);
    } else {
        dolly(camera, std::pow(kDollyStep, io.MouseWheel));
        context.viewMoves = true;
    }
}

/// Asks what the pointer is on.
void pickAt(EditorContext& context, ViewportState& v, bool setsPivot) {
    const ImGuiIO& io = ImGui::GetIO();
    const ViewRectangle& r = context.view;
    const double x = static_cast<double>((io.MousePos.x - r.x) / r.width), y = static_cast<double>((io.MousePos.y - r.y) / r.height);
    if (x < 0.0 || x > 1.0 || y < 0.0 || y > 1.0) return;
    v.pickTicket = context.session.pick(context.state.camera, static_cast<double>(r.aspect()), x, y);
    v.pickSetsPivot = setsPivot;
    v.pickAdds = io.KeyCtrl || io.KeyShift;
}

/// A click without a drag selects what it hits; a double click sets the pivot there.
void pickByPointer(EditorContext& context, ViewportState& v) {
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 way = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0f);
    const bool still = way.x * way.x + way.y * way.y < kClickPixels * kClickPixels;
    const bool released = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && still && !io.KeyAlt;
    const bool doubled = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    const ViewRectangle& r = context.view;
    if (released && takeBvhClick(context, (io.MousePos.x - r.x) / r.width, (io.MousePos.y - r.y) / r.height)) return;
    if (released || doubled) pickAt(context, v, doubled);
}

/// A material that is dropped goes to what the pointer is on.
void takeMaterialDrop(EditorContext& context, ViewportState& v) {
    if (!ImGui::BeginDragDropTarget()) return;
    v.dropped = draggedMaterial();
    if (v.dropped) pickAt(context, v, false);
    ImGui::EndDragDropTarget();
}

/// The instance that was hit alone; with Ctrl or Shift, one more or less.
void selectPicked(EditorContext& context, std::optional<uint32_t> instance, bool adds) {
    editor::Document& document = *context.state.document;
    editor::Selection selection;
    if (adds) selection.instances = document.selection().instances;
    if (instance && std::erase(selection.instances, *instance) == 0) selection.instances.push_back(*instance);
    document.select(selection);
}

void takePick(EditorContext& context, ViewportState& v) {
    if (!context.picked || context.picked->ticket != v.pickTicket) return;
    const PickResult& pick = *context.picked;
    const editor::Document& document = *context.state.document;
    std::optional<uint32_t> instance;  // unless the scene has fewer of them by now
    if (pick.hit && pick.instance < document.rendered()->instances.size()) instance = document.sceneInstance(pick.instance);
    if (const auto material = std::exchange(v.dropped, {})) {
        if (instance) applyEdit(context, editor::assignMaterial({*instance}, *material));
    } else if (!v.pickSetsPivot) {
        selectPicked(context, instance, v.pickAdds);
    } else if (pick.hit) {
        setPivot(context.state.camera, pick.position);
    }
}

/// All of the window but the rectangle.
void fillAround(const ViewRectangle& r) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 color = ImGui::GetColorU32(color::kView);
    const ImVec2 lo = ImGui::GetWindowPos(), size = ImGui::GetWindowSize(), hi(lo.x + size.x, lo.y + size.y);
    const auto fill = [&](const ImVec2& from, const ImVec2& to) {
        if (to.x > from.x && to.y > from.y) list.AddRectFilled(from, to, color);
    };
    fill(lo, {hi.x, r.y});
    fill({lo.x, r.y + r.height}, hi);
    fill({lo.x, r.y}, {r.x, r.y + r.height});
    fill({r.x + r.width, r.y}, {hi.x, r.y + r.height});
}

void showPicture(EditorContext& context, ViewportState& v) {
    const bool isAlone = context.picture != nullptr && !context.states.get<Comparison>().isOn();
    fillAround(isAlone ? context.view : ViewRectangle{});
    if (context.picture == nullptr) return;
    if (v.shown != context.picture->number) {
        context.images.setTexels(v.image, context.picture->texels, context.picture->width, context.picture->height);
        v.shown = context.picture->number;
    }
    if (context.states.get<Comparison>().isOn()) return drawComparison(context, v.image);
    const ViewRectangle& r = context.view;
    context.images.draw(*ImGui::GetWindowDrawList(), v.image, {r.x, r.y}, {r.x + r.width, r.y + r.height}, {0.0f, 0.0f},
                        {1.0f, 1.0f});
}

}  // namespace

void drawViewportPanel(EditorContext& context) {
    auto& v = context.states.get<ViewportState>();
    context.view = fitPicture(context, 0.0f);
    const ViewRectangle rendered = fitPicture(context, context.viewLent);
    const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
    context.viewWidth = static_cast<uint32_t>(std::max(std::round(rendered.width * pixels.x), 1.0f));
    context.viewHeight = static_cast<uint32_t>(std::max(std::round(rendered.height * pixels.y), 1.0f));
    takePick(context, v);
    showPicture(context, v);
    const ImVec2 room = ImGui::GetWindowSize();
    ImGui::SetCursorPos({0.0f, 0.0f});
    ImGui::InvisibleButton("view", room,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
    if (!context.state.hasScene()) return;
    takeMaterialDrop(context, v);
    moveByPointer(context, v);
    flyByKeys(context, v);
    keepHeatMap(context);
    drawHeatMap(context);
    drawViewOverlay(context);
    keepTrees(context);
    drawBvhOverlay(context);
    drawHeatScale(context);
    const bool onHandle = drawComparisonHandles(context) || drawGizmo(context);
    if (!onHandle) pickByPointer(context, v);
}

}  // namespace raylab
