#include "ui/editor/model/edit_cameras.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/scene/import_mesh.h"

namespace raylab::editor {
namespace {

using nlohmann::json;

constexpr const char* kSchema = "raylab.camera/1";
constexpr float kNarrowestRadians = 0.0017453f;
constexpr float kWidestRadians = 3.1241394f;

bool areBounded(glm::vec3 v) {
    return std::abs(v.x) <= kLargestSceneCoordinate && std::abs(v.y) <= kLargestSceneCoordinate &&
           std::abs(v.z) <= kLargestSceneCoordinate;
}

void requireView(const Camera& camera) {
    const bool isFinite = areBounded(camera.position) && areBounded(camera.target) && areBounded(camera.up);
    if (!isFinite || camera.position == camera.target || camera.up == glm::vec3(0.0f))
        throw Error("camera '" + camera.name + "' looks nowhere: its position and target must be finite and differ");
    if (!(camera.fovYRadians >= kNarrowestRadians && camera.fovYRadians <= kWidestRadians))
        throw Error("camera '" + camera.name + "' needs a field of view from 0.1 to 179 degrees");
}

json triple(glm::vec3 v) { return {v.x, v.y, v.z}; }

glm::vec3 tripleOf(const json& values) {
    return {values.at(0).get<float>(), values.at(1).get<float>(), values.at(2).get<float>()};
}

}  // namespace

Edit addCamera(Camera camera) {
    return {"Add camera", [camera = std::move(camera)](EditState& state) {
                requireView(camera);
                state.scene.cameras.push_back(camera);
                state.selection = {};
                state.selection.camera = static_cast<uint32_t>(state.scene.cameras.size() - 1);
            }};
}

Edit setCamera(uint32_t index, Camera camera, const std::string& what, std::string mergeKey) {
    return {"Change " + what + " of camera",
            [index, camera = std::move(camera)](EditState& state) {
                requireView(camera);
                state.scene.cameras[index] = camera;
            },
            std::move(mergeKey)};
}

Edit deleteCamera(uint32_t index) {
    return {"Delete camera", [index](EditState& state) {
                state.scene.cameras.erase(state.scene.cameras.begin() + index);
                state.selection.camera.reset();
            }};
}

float cameraRadius(const Camera& camera) { return glm::distance(camera.position, camera.target); }

Camera atRadius(Camera camera, float radius) {
    camera.position = camera.target + (camera.position - camera.target) * (radius / cameraRadius(camera));
    return camera;
}

Camera movedAlongView(Camera camera, float stepLength, int steps) {
    const float radius = cameraRadius(camera);
    return atRadius(camera, std::max(radius + stepLength * static_cast<float>(steps), 1e-3f * radius));
}

std::string cameraText(const Camera& camera) {
    return json({{"schema", kSchema},
                 {"name", camera.name},
                 {"position", triple(camera.position)},
                 {"target", triple(camera.target)},
                 {"up", triple(camera.up)},
                 {"fovYRadians", camera.fovYRadians}})
        .dump(2, ' ', false, json::error_handler_t::replace);
}

Camera parseCamera(const std::string& text) {
    Camera camera;
    try {
        const json source = json::parse(text);
        if (source.at("schema") != kSchema) throw Error("");
        camera.name = source.value("name", "");
        camera.position = tripleOf(source.at("position"));
        camera.target = tripleOf(source.at("target"));
        camera.up = tripleOf(source.at("up"));
        camera.fovYRadians = source.at("fovYRadians").get<float>();
    } catch (const std::exception&) {
        throw Error("the clipboard holds no camera; copy a view first");
    }
    requireView(camera);
    return camera;
}

std::string cameraArgument(const Camera& camera) {
    std::string text;
    for (const float value : {camera.position.x, camera.position.y, camera.position.z, camera.target.x, camera.target.y,
                              camera.target.z, glm::degrees(camera.fovYRadians)}) {
        char buffer[32];
        const auto [end, code] = std::to_chars(buffer, buffer + sizeof(buffer), value);
        text += (text.empty() ? "" : ",") + std::string(buffer, end);
    }
    return text;
}

}  // namespace raylab::editor
