#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "engine/accel/aabb.h"
#include "engine/measure/stability/test_mesh.h"
#include "tests/support/paths.h"

namespace raylab::accel_test {

using stability::Random;
using stability::randomSoup;
using stability::sphere;
using stability::TestMesh;

/// Long thin triangles as in architectural scans: length 0.5, width 0.5e-3, in every direction.
inline TestMesh randomSlivers(size_t count, uint32_t seed) {
    Random random(seed);
    TestMesh mesh;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 p = random.inCube(0.0f, 1.0f);
        mesh.add(p, p + 0.5f * random.direction(), p + 0.5e-3f * random.direction());
    }
    return mesh;
}

constexpr const char* kNoDragon = "shared/scenes/stanford-dragon/dragon_vrip.ply is not beside the repository";

/// The Stanford dragon, 871,414 triangles, or nothing where the shared scenes are absent.
inline std::optional<TestMesh> readDragon() {
    const std::filesystem::path path =
        support::sharedScenes() / "stanford-dragon/dragon_vrip.ply";
    if (!std::filesystem::exists(path)) return std::nullopt;
    std::ifstream stream(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    const auto countAfter = [&](const std::string& key) {
        return std::stoul(bytes.substr(bytes.find(key) + key.size(), 12));
    };
    TestMesh mesh;
    mesh.positions.resize(countAfter("element vertex "));
    mesh.triangles.resize(countAfter("element face "));
    const std::string end = "end_header\n";
    const char* next = bytes.data() + bytes.find(end) + end.size();
    std::memcpy(mesh.positions.data(), next, mesh.positions.size() * sizeof(glm::vec3));
    next += mesh.positions.size() * sizeof(glm::vec3);
    for (glm::uvec3& triangle : mesh.triangles) {
        std::memcpy(&triangle, next + 1, sizeof(triangle));  // after the count of corners, a byte
        next += 1 + sizeof(triangle);
    }
    return mesh;
}

}  // namespace raylab::accel_test
