#include <glm/glm.hpp>
#include <optional>

#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_nodes.h"
#include "engine/scene/instance_motion.h"
#include "engine/scene/mesh_shading.h"
#include "engine/scene/quadric.h"
#include "engine/scene/save_parts.h"

namespace raylab {
namespace {

using nlohmann::json;

template <int columns, class T>
json matrixJson(const glm::mat<columns, 4, T>& matrix) {
    json values = json::array();
    for (int c = 0; c < columns; ++c)
        for (int r = 0; r < 4; ++r) values.push_back(matrix[c][r]);
    return values;
}

/// A tightly packed accessor over a buffer view of its own.
template <class T>
size_t addAccessor(GltfDraft& draft, const std::vector<T>& values, ComponentType type, const char* shape,
                   size_t count) {
    const size_t view = addBufferView(draft, std::as_bytes(std::span(values)));
    return appendTo(
        draft.document, "accessors",
        {{"bufferView", view}, {"componentType", static_cast<uint32_t>(type)}, {"type", shape}, {"count", count}});
}

template <class T>
size_t addFloats(GltfDraft& draft, const std::vector<T>& values, const char* shape) {
    return addAccessor(draft, values, ComponentType::f32, shape, values.size());
}

/// With the bounds that glTF wants of positions.
size_t addPositions(GltfDraft& draft, const std::vector<glm::vec3>& positions) {
    glm::vec3 low = positions.front(), high = low;
    for (const glm::vec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const size_t accessor = addFloats(draft, positions, "VEC3");
    draft.document["accessors"][accessor]["min"] = toJson(low);
    draft.document["accessors"][accessor]["max"] = toJson(high);
    return accessor;
}

size_t addMesh(GltfDraft& draft, const Mesh& mesh) {
    json attributes = {{"POSITION", addPositions(draft, mesh.positions)}};
    if (!mesh.normals.empty()) attributes["NORMAL"] = addFloats(draft, mesh.normals, "VEC3");
    if (!mesh.uvs.empty()) attributes["TEXCOORD_0"] = addFloats(draft, mesh.uvs, "VEC2");
    // glTF has readers ignore tangents where there are no normals; ours computes both kinds anew.
    if (!mesh.tangents.empty() && !mesh.normals.empty())
        attributes["TANGENT"] = addFloats(draft, mesh.tangents, "VEC4");
    const size_t indices = addAccessor(draft, mesh.triangles, ComponentType::u32, "SCALAR", 3 * mesh.triangles.size());
    const json primitive = {{"attributes", attributes}, {"indices", indices}, {"material", mesh.material}};
    return appendTo(draft.document, "meshes", {{"name", mesh.name}, {"primitives", json::array({primitive})}});
}

size_t addQuadrics(json& document, const Mesh& mesh) {
    json surfaces = json::array();
    for (const Quadric& quadric : mesh.quadrics)
        surfaces.push_back({{"kind", kQuadricKindNames[static_cast<size_t>(quadric.kind)]},
                            {"radii", toJson(quadric.radii)},
                            {"clip", {quadric.clipLow, quadric.clipHigh}}});
    return appendTo(document["extras"]["raylab"], "quadrics",
                    {{"name", mesh.name}, {"material", mesh.material}, {"surfaces", surfaces}});
}

void addNode(json& document, json node) {
    document["scenes"][0]["nodes"].push_back(appendTo(document, "nodes", std::move(node)));
}

/// `stored[m]`: index of mesh m among the meshes or among the quadrics of the file; nothing for a mesh without
/// primitives.
void addInstances(const Scene& scene, const std::vector<std::optional<size_t>>& stored, json& document) {
    for (const Instance& instance : scene.instances) {
        if (!stored[instance.mesh]) continue;
        json node = {{"name", instance.name}};
        if (scene.meshes[instance.mesh].quadrics.empty())
            node["mesh"] = *stored[instance.mesh];
        else
            node["extras"]["raylab"]["quadrics"] = *stored[instance.mesh];
        if (instance.objectToWorld != glm::mat4(1.0f)) node["matrix"] = matrixJson(instance.objectToWorld);
        if (moves(instance)) node["extras"]["raylab"]["endMatrix"] = matrixJson(*instance.endToWorld);
        addNode(document, std::move(node));
    }
}

void addCamera(const Camera& camera, json& document) {
    const float nearest = glm::max(0.01f * glm::distance(camera.position, camera.target), 1e-6f);
    const json exact = {{"target", toJson(camera.target)}, {"up", toJson(camera.up)}};
    const size_t index = appendTo(document, "cameras",
                                  {{"name", camera.name},
                                   {"type", "perspective"},
                                   {"perspective", {{"yfov", camera.fovYRadians}, {"znear", nearest}}},
                                   {"extras", {{"raylab", exact}}}});
    addNode(document, {{"name", camera.name}, {"camera", index}, {"matrix", matrixJson(cameraToWorld(camera))}});
}

const char* lightType(LightKind kind) {
    switch (kind) {
        case LightKind::point:
        case LightKind::sphere:
            return "point";
        case LightKind::directional:
            return "directional";
        case LightKind::spot:
        case LightKind::disc:
        case LightKind::rectangle:
            return "spot";
    }
    return "";
}

/// Nothing where the light has no size.
json shapeJson(const Light& light) {
    switch (light.kind) {
        case LightKind::sphere:
            return {{"shape", "sphere"}, {"radius", light.radius}};
        case LightKind::disc:
            return {{"shape", "disc"}, {"radius", light.radius}};
        case LightKind::rectangle:
            return {{"shape", "rectangle"}, {"width", light.size.x}, {"height", light.size.y}};
        case LightKind::directional:
            return light.angularRadiusRadians > 0.0f ? json{{"angularRadius", light.angularRadiusRadians}} : json();
        case LightKind::point:
        case LightKind::spot:
            break;
    }
    return {};
}

/// A spot light's cone. A flat lamp sends into a half space.
json coneJson(const Light& light) {
    constexpr double kQuarterTurn = 1.5707963267948966;
    if (light.kind == LightKind::spot)
        return {{"innerConeAngle", light.innerConeRadians}, {"outerConeAngle", light.outerConeRadians}};
    return {{"innerConeAngle", 0.0}, {"outerConeAngle", kQuarterTurn}};
}

void addLight(const Light& light, json& document) {
    constexpr const char* kExtension = "KHR_lights_punctual";
    const float strength = powerOfTwoScale(light.intensity);
    json entry = {{"name", light.name},
                  {"type", lightType(light.kind)},
                  {"color", toJson(light.intensity / strength)},
                  {"intensity", strength}};
    if (entry["type"] == "spot") entry["spot"] = coneJson(light);
    if (json shape = shapeJson(light); !shape.is_null()) entry["extras"]["raylab"] = std::move(shape);
    useExtension(document, kExtension);
    const size_t index = appendTo(document["extensions"][kExtension], "lights", std::move(entry));
    const glm::vec3 z = -light.direction, x = light.kind == LightKind::rectangle ? light.tangent : anyOrthogonal(z);
    const glm::mat4 pose(glm::vec4(x, 0.0f), glm::vec4(glm::cross(z, x), 0.0f), glm::vec4(z, 0.0f),
                         glm::vec4(light.position, 1.0f));
    json node = {{"name", light.name}, {"matrix", matrixJson(pose)}};
    node["extensions"][kExtension]["light"] = index;
    addNode(document, std::move(node));
}

}  // namespace

void addMeshesAndNodes(const Scene& scene, GltfDraft& draft) {
    std::vector<std::optional<size_t>> stored(scene.meshes.size());
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        if (!mesh.triangles.empty()) stored[m] = addMesh(draft, mesh);
        if (!mesh.quadrics.empty()) stored[m] = addQuadrics(draft.document, mesh);
    }
    addInstances(scene, stored, draft.document);
    for (const Camera& camera : scene.cameras) addCamera(camera, draft.document);
    for (const Light& light : scene.lights) addLight(light, draft.document);
}

}  // namespace raylab
