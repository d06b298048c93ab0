#include "ui/editor/gizmo_overlay.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "engine/scene/bounds.h"
#include "ui/editor/mesh_box.h"
#include "ui/editor/model/edit_instances.h"
#include "ui/editor/model/edit_lights.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

using editor::GizmoHandle;
using editor::GizmoMode;

constexpr float kThickness = 2.5f;

/// A drag that is under way, with what it moves as it was in the beginning.
struct GizmoGrab {
    editor::GizmoDrag drag;
    std::vector<editor::Placement> instances;
    std::optional<Light> light;
    int number = 0;
};

struct GizmoState {
    std::optional<GizmoGrab> grab;
    int grabs = 0;  ///< so far: a drag is a step of its own
};

const char* verbOf(GizmoMode mode) {
    constexpr std::array kVerbs = {"Move", "Rotate", "Scale"};
    return kVerbs[static_cast<size_t>(mode)];
}

/// Where the gizmo stands and its local axes; an instance's is in the middle of its box, for many a file has all its
/// vertices in world space. Nothing where nothing can be dragged.
std::optional<glm::mat4> pivotOf(const EditorContext& context) {
    const editor::Selection& selection = context.state.document->selection();
    const Scene& scene = context.state.scene();
    if (!selection.instances.empty()) {
        const Instance& active = scene.instances[selection.instances.back()];
        const Bounds& box = meshBox(scene, active.mesh);
        glm::mat4 pivot = active.objectToWorld;
        pivot[3] = active.objectToWorld * glm::vec4(0.5f * (box.lo + box.hi), 1.0f);
        return pivot;
    }
    if (!selection.light) return std::nullopt;
    const Light& light = scene.lights[*selection.light];
    const bool fits = context.gizmoMode == GizmoMode::move
                          ? light.kind != LightKind::directional
                          : context.gizmoMode == GizmoMode::rotate && light.kind != LightKind::point;
    const glm::vec3 at = light.kind == LightKind::directional ? context.state.camera.target : light.position;
    return fits ? std::optional(glm::translate(glm::mat4(1.0f), at)) : std::nullopt;
}

GizmoGrab grab(const EditorContext& context, editor::GizmoDrag drag, int number) {
    GizmoGrab result{std::move(drag), {}, {}, number};
    const editor::Selection& selection = context.state.document->selection();
    for (const uint32_t i : selection.instances)
        result.instances.push_back({i, context.state.scene().instances[i].objectToWorld});
    if (selection.instances.empty() && selection.light) result.light = context.state.scene().lights[*selection.light];
    return result;
}

Light mapped(Light light, const glm::mat4& map) {
    if (light.kind != LightKind::directional) light.position = glm::vec3(map * glm::vec4(light.position, 1.0f));
    light.direction = glm::normalize(glm::mat3(map) * light.direction);
    return light;
}

void dragTo(EditorContext& context, GizmoGrab& held, const glm::dvec2& pixel) {
    const editor::GizmoSnap snap = ImGui::GetIO().KeyCtrl ? context.gizmoSnap : editor::GizmoSnap{};
    const glm::dmat4 map = held.drag.at(pixel, snap);
    const std::string key = "gizmo " + std::to_string(held.number);
    if (held.light) {
        const uint32_t index = *context.state.document->selection().light;
        applyEdit(context, editor::setLight(index, mapped(*held.light, glm::mat4(map)), "place", key));
        return;
    }
    std::vector<editor::Placement> placements = held.instances;
    for (editor::Placement& each : placements) each.objectToWorld = glm::mat4(map * glm::dmat4(each.objectToWorld));
    applyEdit(context, editor::placeInstances(std::move(placements), verbOf(context.gizmoMode), key));
}

ImU32 colorOf(GizmoHandle handle, bool isLit) {
    if (isLit) return IM_COL32(255, 220, 90, 255);
    constexpr std::array<ImU32, 3> kAxes = {IM_COL32(232, 82, 82, 255), IM_COL32(112, 200, 86, 255),
                                            IM_COL32(82, 138, 240, 255)};
    return handle == GizmoHandle::center ? IM_COL32(225, 225, 230, 230) : kAxes[static_cast<size_t>(handle) % 3];
}

/// The end of an arm: a head, or a block where it scales.
void drawTip(ImDrawList& list, const ImVec2& from, const ImVec2& to, GizmoMode mode, ImU32 ink, float scale) {
    const float size = 5.0f * scale;
    if (mode == GizmoMode::scale) {
        list.AddRectFilled({to.x - size, to.y - size}, {to.x + size, to.y + size}, ink);
        return;
    }
    const float length = std::max(std::hypot(to.x - from.x, to.y - from.y), 1e-3f);
    const ImVec2 along((to.x - from.x) / length * size, (to.y - from.y) / length * size);
    list.AddTriangleFilled({to.x + 2.2f * along.x, to.y + 2.2f * along.y}, {to.x - along.y, to.y + along.x},
                           {to.x + along.y, to.y - along.x}, ink);
}

void drawParts(const EditorContext& context, std::span<const editor::GizmoPart> parts, std::optional<GizmoHandle> lit) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float scale = context.scale;
    for (const editor::GizmoPart& part : parts) {
        std::vector<ImVec2> line;
        for (const glm::dvec2& p : part.pixels)
            line.push_back({context.view.x + static_cast<float>(p.x), context.view.y + static_cast<float>(p.y)});
        const ImU32 ink = colorOf(part.handle, lit == part.handle);
        const int count = static_cast<int>(line.size());
        if (part.isArea) {
            list.AddConvexPolyFilled(line.data(), count, (ink & 0x00FFFFFFu) | 0x70000000u);
            list.AddPolyline(line.data(), count, ink, ImDrawFlags_Closed, scale);
            continue;
        }
        const bool isOuter = part.handle == GizmoHandle::center;
        list.AddPolyline(line.data(), count, ink, ImDrawFlags_None, (isOuter ? 1.5f : kThickness) * scale);
        if (context.gizmoMode != GizmoMode::rotate)
            drawTip(list, line.front(), line.back(), context.gizmoMode, ink, scale);
    }
}

/// Beside the pointer: how far, by how much.
void drawAmount(const EditorContext& context, const glm::dvec3& a) {
    char text[96];
    if (context.gizmoMode == GizmoMode::rotate)
        std::snprintf(text, sizeof(text), "%.1f deg", a.x);
    else
        std::snprintf(text, sizeof(text), "%.3f  %.3f  %.3f", a.x, a.y, a.z);
    const ImVec2 at = ImGui::GetIO().MousePos, size = ImGui::CalcTextSize(text);
    const ImVec2 corner(at.x + 18.0f * context.scale, at.y + 14.0f * context.scale);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({corner.x - 4.0f, corner.y - 2.0f}, {corner.x + size.x + 4.0f, corner.y + size.y + 2.0f},
                       IM_COL32(20, 20, 24, 200), 3.0f);
    list.AddText(corner, ImGui::GetColorU32(color::kText), text);
}

}  // namespace

bool drawGizmo(EditorContext& context) {
    auto& state = context.states.get<GizmoState>();
    const bool isHeld = ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    const bool isPressed =
        ImGui::IsItemActivated() && ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::GetIO().KeyAlt;
    const bool isReleased = state.grab && !isHeld;
    const std::optional<glm::mat4> pivot = pivotOf(context);
    if (isReleased || !pivot) state.grab.reset();
    if (!pivot) return isReleased;
    const ViewRectangle& r = context.view;
    const editor::GizmoView view(context.state.camera, static_cast<double>(r.width), static_cast<double>(r.height));
    const editor::GizmoPose pose = editor::gizmoPose(view, context.gizmoMode, context.gizmoSpace, *pivot,
                                                     editor::kGizmoArmPixels * static_cast<double>(context.scale));
    const std::vector<editor::GizmoPart> parts = editor::gizmoParts(view, context.gizmoMode, pose);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const glm::dvec2 pixel(static_cast<double>(mouse.x - r.x), static_cast<double>(mouse.y - r.y));
    std::optional<GizmoHandle> lit;
    if (state.grab)
        lit = state.grab->drag.handle();
    else if (ImGui::IsItemHovered())
        lit = editor::hitGizmo(parts, pixel);
    if (isPressed && lit) {
        context.gizmoSnap = editor::snapSteps(pose);
        state.grab = grab(context, editor::GizmoDrag(view, context.gizmoMode, pose, *lit, pixel), ++state.grabs);
    }
    if (state.grab) dragTo(context, *state.grab, pixel);
    ImGui::GetWindowDrawList()->PushClipRect({r.x, r.y}, {r.x + r.width, r.y + r.height}, true);
    drawParts(context, parts, lit);
    ImGui::GetWindowDrawList()->PopClipRect();
    if (state.grab) drawAmount(context, state.grab->drag.amount());
    return lit.has_value() || isReleased;
}

}  // namespace raylab
