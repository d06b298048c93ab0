#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "engine/accel/aabb.h"
#include "engine/accel/brute_force.h"
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

/// Cubes on an integer grid, so that origins and directions can lie exactly in faces and along axes.
inline TestMesh gridOfCubes() {
    TestMesh mesh;
    for (int i = 0; i < 64; ++i) {
        const glm::vec3 lo = 2.0f * glm::vec3(glm::ivec3(i, i >> 2, i >> 4) & 3);
        for (int axis = 0; axis < 3; ++axis)
            for (const float side : {0.0f, 1.0f}) {
                glm::vec3 a(0.0f);
                glm::vec3 b(0.0f);
                glm::vec3 corner = lo;
                corner[axis] += side;
                a[(axis + 1) % 3] = 1.0f;
                b[(axis + 2) % 3] = 1.0f;
                mesh.add(corner, corner + a, corner + a + b);
                mesh.add(corner, corner + a + b, corner + b);
            }
    }
    return mesh;
}

/// For gridOfCubes(): along axes or nearly so, with components of 0, -0 and denormals.
inline std::vector<OracleRay> raysAlongAxes(size_t count, uint32_t seed) {
    Random random(seed);
    const std::array<float, 5> tiny = {0.0f, -0.0f, 1e-42f, -1e-42f, 1e-30f};
    std::vector<OracleRay> rays;
    for (size_t i = 0; i < count; ++i) {
        // Coordinates in planes of faces in half of the rays; the origin outside, between or inside the cubes.
        glm::vec3 o = random.inCube(-2.0f, 9.0f);
        if (i % 2 == 0) o[static_cast<int>(random.below(3))] = static_cast<float>(random.below(9)) - 1.0f;
        const auto axis = static_cast<int>(random.below(3));
        glm::vec3 d(tiny[random.below(5)], tiny[random.below(5)], tiny[random.below(5)]);
        d[axis] = random.below(2) == 0 ? 1.0f : -1.0f;
        if (i % 5 == 0) d[(axis + 1) % 3] = random.uniform(-1.0f, 1.0f);
        rays.push_back({o, d, 1e-4f});  // many origins lie on a face, whose t is 0 but for rounding
    }
    return rays;
}

/// Bases of flattened trees that are not zero.
constexpr uint32_t kNodeBase = 1000;
constexpr uint32_t kSlotBase = 5000;

/// From around and inside the box towards points in it; lengths of d from 1e-3 to 1e3.
inline std::vector<OracleRay> randomRays(const Aabb& box, size_t count, uint32_t seed) {
    Random random(seed);
    std::vector<OracleRay> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 o = box.centroid() + random.inCube(-1.0f, 1.0f) * box.extent();
        const glm::vec3 target = box.centroid() + random.inCube(-0.5f, 0.5f) * box.extent();
        const float length = std::pow(10.0f, random.uniform(-3.0f, 3.0f));
        rays.push_back({o, length * glm::normalize(target - o)});
    }
    return rays;
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
