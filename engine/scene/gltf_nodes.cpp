#include "engine/scene/gltf_nodes.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>

#include "engine/scene/gltf_animation.h"
#include "engine/scene/gltf_extras.h"
#include "engine/scene/import_parts.h"
#include "engine/scene/mesh_shading.h"

namespace raylab {
namespace {

/// How often shared children may be placed beyond once a node. A tree, the only thing that glTF allows, needs none.
constexpr size_t kMostExtraPlacements = 1'000'000;

glm::dmat4 matrixUnder(const JsonView& owner, const char* key) {
    glm::dmat4 matrix = glm::make_mat4(owner.numbers(key, std::vector<double>(16)).data());
    for (int c = 0; c < 4; ++c) matrix[c][3] = c == 3 ? 1.0 : 0.0;  // glTF allows affine maps only
    return matrix;
}

NodePose poseOf(const JsonView& node) {
    const std::vector<double> t = node.numbers("translation", {0.0, 0.0, 0.0});
    const std::vector<double> r = node.numbers("rotation", {0.0, 0.0, 0.0, 1.0});
    const std::vector<double> s = node.numbers("scale", {1.0, 1.0, 1.0});
    glm::dquat rotation(r[3], r[0], r[1], r[2]);
    rotation = glm::length(rotation) > 0.0 ? glm::normalize(rotation) : glm::dquat(1.0, 0.0, 0.0, 0.0);
    return {{t[0], t[1], t[2]}, rotation, {s[0], s[1], s[2]}};
}

struct Node {
    glm::dmat4 local{1.0};
    glm::dmat4 localEnd{1.0};  ///< where the shutter closes
    std::vector<size_t> children;
};

/// The file's own transform, where the shutter closes that of `extras.raylab.endMatrix`.
Node readNode(const JsonView& json, size_t nodeCount) {
    Node node;
    node.local = json.has("matrix") ? matrixUnder(json, "matrix") : poseOf(json).matrix();
    const std::optional<JsonView> extras = raylabExtras(json);
    node.localEnd = extras && extras->has("endMatrix") ? matrixUnder(*extras, "endMatrix") : node.local;
    const JsonView children = json.array("children");
    for (size_t c = 0; c < children.size(); ++c) node.children.push_back(children.indexAt(c, nodeCount));
    return node;
}

/// The nodes that the file's animation moves, at both ends of the shutter.
void animate(const GltfDocument& document, const JsonView& json, std::vector<Node>& nodes) {
    const std::optional<Shutter> shutter = readShutter(document);
    if (!shutter) return;
    std::map<size_t, std::pair<NodePose, NodePose>> poses;
    for (const AnimationChannel& channel : readAnimation(document)) {
        const NodePose pose = poseOf(json.element(channel.node));
        auto& [open, close] = poses.try_emplace(channel.node, pose, pose).first->second;
        applyChannel(channel, shutter->open, open);
        applyChannel(channel, shutter->close, close);
    }
    for (const auto& [node, ends] : poses) {
        nodes[node].local = ends.first.matrix();
        nodes[node].localEnd = ends.second.matrix();
    }
}

std::vector<size_t> rootNodes(const JsonView& root) {
    const JsonView nodes = root.array("nodes");
    const JsonView scenes = root.array("scenes");
    std::vector<size_t> roots;
    if (scenes.size() > 0) {
        const JsonView shown = scenes.element(root.index("scene", scenes.size()).value_or(0)).array("nodes");
        for (size_t i = 0; i < shown.size(); ++i) roots.push_back(shown.indexAt(i, nodes.size()));
        return roots;
    }
    std::vector<bool> hasParent(nodes.size(), false);
    for (size_t n = 0; n < nodes.size(); ++n) {
        const JsonView children = nodes.element(n).array("children");
        for (size_t c = 0; c < children.size(); ++c) hasParent[children.indexAt(c, nodes.size())] = true;
    }
    for (size_t n = 0; n < nodes.size(); ++n)
        if (!hasParent[n]) roots.push_back(n);
    return roots;
}

/// The unit vector along column `axis`; the identity's where a scale of 0 leaves no direction.
glm::dvec3 axisOf(const glm::dmat4& matrix, int axis) {
    const glm::dvec3 column(matrix[axis]);
    if (isUnit(column)) return column;
    const double length = glm::length(column);
    return length > 0.0 ? column / length : glm::dvec3(glm::dmat3(1.0)[axis]);
}

/// To a microradian, which lets through what another program's single precision makes of a matrix. False for a zero
/// axis.
bool sameView(const glm::dmat4& a, const glm::dmat4& b) {
    const auto aligned = [&](int axis) {
        return glm::dot(glm::normalize(glm::dvec3(a[axis])), glm::normalize(glm::dvec3(b[axis]))) > 1.0 - 1e-12;
    };
    return aligned(1) && aligned(2);
}

/// The view as it was saved, unless the node shows another one by now.
void restoreView(const JsonView& json, const PlacedNode& placed, Camera& camera) {
    const std::optional<JsonView> extras = raylabExtras(json);
    if (!extras || !extras->has("target")) return;
    Camera saved = camera;
    saved.target = extras->vec3("target", camera.target);
    saved.up = extras->vec3("up", camera.up);
    if (sameView(cameraToWorld(saved), placed.toWorld)) camera = saved;
}

Camera perspectiveCamera(const JsonView& json, const PlacedNode& placed) {
    Camera camera;
    camera.position = glm::dvec3(placed.toWorld[3]);
    const glm::dvec3 forward = -axisOf(placed.toWorld, 2);
    const double reach = std::max(1.0, glm::length(glm::dvec3(placed.toWorld[3])));
    camera.target = glm::dvec3(placed.toWorld[3]) + forward * reach;
    camera.up = axisOf(placed.toWorld, 1);
    camera.fovYRadians = static_cast<float>(json.object("perspective").number("yfov", 0.8));
    if (!(camera.fovYRadians > 0.0f && camera.fovYRadians < 3.14f)) json.fail("needs a yfov between 0 and pi radians");
    restoreView(json, placed, camera);
    return camera;
}

LightKind lightKind(const JsonView& light) {
    const std::string type = light.text("type", "");
    if (type == "point") return LightKind::point;
    if (type == "spot") return LightKind::spot;
    if (type == "directional") return LightKind::directional;
    light.fail("has the type \"" + type + "\"; KHR_lights_punctual knows point, spot and directional");
}

float positiveNumber(const JsonView& owner, const char* key) {
    const auto value = static_cast<float>(numberBetween(owner, key, 0.0, 1e9, 0.0));
    if (!(value > 0.0f)) owner.fail(std::string("needs a ") + key + " above 0");
    return value;
}

/// What extras.raylab says of a light's size. A point becomes a sphere; a spot a disc or a rectangle.
void readShape(const JsonView& extras, const PlacedNode& placed, Light& light) {
    constexpr double kQuarterTurn = 1.5707963267948966;
    if (light.kind == LightKind::directional) {
        light.angularRadiusRadians = static_cast<float>(numberBetween(extras, "angularRadius", 0.0, kQuarterTurn, 0.0));
        return;
    }
    if (!extras.has("shape")) return;
    const std::string shape = extras.text("shape", "");
    if (shape == "sphere" && light.kind == LightKind::point) {
        light.kind = LightKind::sphere;
        light.radius = positiveNumber(extras, "radius");
    } else if (shape == "disc" && light.kind == LightKind::spot) {
        light.kind = LightKind::disc;
        light.radius = positiveNumber(extras, "radius");
    } else if (shape == "rectangle" && light.kind == LightKind::spot) {
        light.kind = LightKind::rectangle;
        light.size = {positiveNumber(extras, "width"), positiveNumber(extras, "height")};
        light.tangent = axisOf(placed.toWorld, 0);
    } else {
        extras.fail("has the shape \"" + shape + "\"; a point light may be a sphere, a spot light a disc or a rectangle");
    }
}

Light punctualLight(const JsonView& json, const PlacedNode& placed) {
    Light light;
    light.kind = lightKind(json);
    light.position = glm::dvec3(placed.toWorld[3]);
    light.direction = -axisOf(placed.toWorld, 2);
    light.intensity = json.vec3("color", glm::vec3(1.0f)) * static_cast<float>(json.number("intensity", 1.0));
    if (const std::optional<JsonView> extras = raylabExtras(json)) readShape(*extras, placed, light);
    if (light.kind != LightKind::spot) return light;
    const JsonView spot = json.object("spot");
    light.outerConeRadians = static_cast<float>(spot.number("outerConeAngle", 0.7853981633974483));
    light.innerConeRadians = std::min(static_cast<float>(spot.number("innerConeAngle", 0.0)), light.outerConeRadians);
    return light;
}

}  // namespace

glm::dmat4 cameraToWorld(const Camera& camera) {
    const glm::dvec3 axis = glm::dvec3(camera.target) - glm::dvec3(camera.position);
    const glm::dvec3 forward = glm::length(axis) > 0.0 ? glm::normalize(axis) : glm::dvec3(0.0, 0.0, -1.0);
    const glm::dvec3 side = glm::cross(forward, glm::dvec3(camera.up));
    const glm::dvec3 right =
        glm::length(side) > 0.0 ? glm::normalize(side) : glm::normalize(glm::dvec3(anyOrthogonal(forward)));
    return glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(right, forward), 0.0), glm::dvec4(-forward, 0.0),
                      glm::dvec4(camera.position, 1.0));
}

std::vector<PlacedNode> placeNodes(const GltfDocument& document) {
    const JsonView root = document.root();
    const JsonView json = root.array("nodes");
    std::vector<Node> nodes;
    for (size_t n = 0; n < json.size(); ++n) nodes.push_back(readNode(json.element(n), json.size()));
    std::vector<PlacedNode> placed;
    std::vector<PlacedNode> stack;
    const std::vector<size_t> roots = rootNodes(root);
    animate(document, json, nodes);
    for (auto it = roots.rbegin(); it != roots.rend(); ++it) stack.push_back({*it, nodes[*it].local, nodes[*it].localEnd});
    while (!stack.empty()) {
        const PlacedNode current = stack.back();
        stack.pop_back();
        placed.push_back(current);
        if (placed.size() > nodes.size() + kMostExtraPlacements) json.fail("share children more than a million times");
        const std::vector<size_t>& children = nodes[current.node].children;
        for (auto it = children.rbegin(); it != children.rend(); ++it)
            stack.push_back({*it, current.toWorld * nodes[*it].local, current.endToWorld * nodes[*it].localEnd});
    }
    return placed;
}

void readGltfCameras(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Scene& scene) {
    const JsonView cameras = document.root().array("cameras");
    const JsonView allNodes = document.root().array("nodes");
    if (cameras.size() == 0) return;
    for (const PlacedNode& placed : nodes) {
        const JsonView node = allNodes.element(placed.node);
        const std::optional<size_t> index = node.index("camera", cameras.size());
        if (!index) continue;
        const JsonView json = cameras.element(*index);
        const std::string name = json.text("name", node.text("name", "camera " + std::to_string(*index)));
        if (json.text("type", "perspective") != "perspective") {
            scene.warnings.push_back("camera \"" + name +
                                     "\" is orthographic and was left out: cameras are perspective");
            continue;
        }
        if (!isBounded(placed.toWorld)) {
            scene.warnings.push_back("camera \"" + name + "\" has a non-finite transform and was left out");
            continue;
        }
        scene.cameras.push_back(perspectiveCamera(json, placed));
        scene.cameras.back().name = name;
    }
}

void readGltfLights(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Scene& scene) {
    const JsonView lights = document.root().object("extensions").object("KHR_lights_punctual").array("lights");
    const JsonView allNodes = document.root().array("nodes");
    if (lights.size() == 0) return;
    for (const PlacedNode& placed : nodes) {
        const JsonView node = allNodes.element(placed.node);
        const auto index = node.object("extensions").object("KHR_lights_punctual").index("light", lights.size());
        if (!index) continue;
        const JsonView json = lights.element(*index);
        const std::string name = json.text("name", node.text("name", "light " + std::to_string(*index)));
        if (!isBounded(placed.toWorld)) {
            scene.warnings.push_back("light \"" + name + "\" has a non-finite transform and was left out");
            continue;
        }
        Light light = punctualLight(json, placed);
        light.name = name;
        if (glm::any(glm::lessThan(light.intensity, glm::vec3(0.0f)))) {
            scene.warnings.push_back("light \"" + light.name + "\" has a negative intensity, taken as 0");
            light.intensity = glm::max(light.intensity, glm::vec3(0.0f));
        }
        scene.lights.push_back(light);
    }
}

}  // namespace raylab
