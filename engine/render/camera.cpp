#include "engine/render/camera.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/bounds.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

/// Numbers between commas; empty where the text is anything else.
std::vector<float> commaNumbers(const std::string& text) {
    std::vector<float> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at < end) {
        float value = 0.0f;
        const auto [next, code] = std::from_chars(at, end, value);
        if (code != std::errc() || !std::isfinite(value) || (next != end && *next != ',')) return {};
        numbers.push_back(value);
        at = next == end ? end : next + 1;
    }
    return numbers;
}

Camera cameraFromNumbers(const std::vector<float>& n, const std::string& text) {
    Camera camera;
    camera.name = "command line";
    camera.position = {n[0], n[1], n[2]};
    camera.target = {n[3], n[4], n[5]};
    camera.fovYRadians = glm::radians(n[6]);
    if (camera.position == camera.target || !(n[6] > 0.0f && n[6] < 180.0f))
        throw Error("--camera " + text + ": position and target must differ, and the field of view lie between 0 and 180");
    return camera;
}

std::string cameraList(const Scene& scene) {
    std::string text;
    for (size_t i = 0; i < scene.cameras.size(); ++i)
        text += (i == 0 ? "" : ", ") + std::to_string(i) + " '" + scene.cameras[i].name + "'";
    return text.empty() ? "none; 0 is a view of the whole" : text;
}

}  // namespace

Camera chooseCamera(const Scene& scene, const std::string& text) {
    const std::vector<float> numbers = commaNumbers(text);
    if (numbers.size() == 7) return cameraFromNumbers(numbers, text);
    for (const Camera& camera : scene.cameras)
        if (camera.name == text) return camera;
    if (text == "0" && scene.cameras.empty()) return defaultCamera(scene);
    size_t index = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (code == std::errc() && end == text.data() + text.size() && index < scene.cameras.size()) return scene.cameras[index];
    throw Error("--camera " + text + ": no such camera; the scene has " + cameraList(scene) +
                "; or give px,py,pz,tx,ty,tz,fov");
}

std::string cameraNumbers(const Camera& camera) {
    std::string text;
    for (const float value : {camera.position.x, camera.position.y, camera.position.z, camera.target.x, camera.target.y,
                              camera.target.z, glm::degrees(camera.fovYRadians)}) {
        std::array<char, 32> digits{};
        const auto [end, code] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
        text += (text.empty() ? "" : ",") + std::string(digits.data(), end);
    }
    return text;
}

void writeCamera(const Camera& camera, uint32_t width, uint32_t height, shared::FrameParams& frame) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
    glm::dvec3 up(camera.up);
    if (glm::length(glm::cross(forward, up)) < 1e-6) up = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    const double halfHeight = std::tan(0.5 * static_cast<double>(camera.fovYRadians));
    frame.cameraPosition = camera.position;
    frame.cameraForward = glm::vec3(forward);
    frame.cameraRight = glm::vec3(right * (halfHeight * width / height));
    frame.cameraUp = glm::vec3(glm::cross(right, forward) * halfHeight);
    frame.pixelSpread = static_cast<float>(2.0 * halfHeight / height);
    frame.width = width;
    frame.height = height;
    frame.tilesPerRow = (width + shared::kTileSize - 1) / shared::kTileSize;
}

void writeCameraEnd(const Camera& camera, double shutter, shared::FrameParams& frame) {
    shared::FrameParams end{};
    writeCamera(camera, frame.width, frame.height, end);
    frame.endPosition = end.cameraPosition;
    frame.endRight = end.cameraRight;
    frame.endUp = end.cameraUp;
    frame.endForward = end.cameraForward;
    frame.shutter = static_cast<float>(shutter);
}

void writeLens(const Camera& camera, double lensRadius, double focusDistance, shared::FrameParams& frame) {
    frame.lensRadius = static_cast<float>(lensRadius);
    frame.focusDistance = focusDistance > 0.0 ? static_cast<float>(focusDistance)
                                              : glm::length(camera.target - camera.position);
}

}  // namespace raylab
