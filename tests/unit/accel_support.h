#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "engine/accel/aabb.h"

namespace raylab::accel_test {

struct TestMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;

    void add(const glm::vec3& p0, const glm::vec3& p1, const glm::vec3& p2) {
        const auto first = static_cast<uint32_t>(positions.size());
        for (const glm::vec3& corner : {p0, p1, p2}) positions.push_back(corner);
        triangles.emplace_back(first, first + 1, first + 2);
    }
};

class Random {
public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    float uniform(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(engine_); }
    uint32_t below(uint32_t n) { return std::uniform_int_distribution<uint32_t>(0, n - 1)(engine_); }
    glm::vec3 inCube(float lo, float hi) { return {uniform(lo, hi), uniform(lo, hi), uniform(lo, hi)}; }
    glm::vec3 direction() {
        glm::vec3 d;
        do d = inCube(-1.0f, 1.0f);
        while (glm::dot(d, d) > 1.0f || glm::dot(d, d) < 0.01f);
        return glm::normalize(d);
    }

private:
    std::mt19937 engine_;
};

/// Triangles of about `size` scattered over the unit cube.
inline TestMesh randomSoup(size_t count, float size, uint32_t seed) {
    Random random(seed);
    TestMesh mesh;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 p = random.inCube(0.0f, 1.0f);
        mesh.add(p, p + random.inCube(-size, size), p + random.inCube(-size, size));
    }
    return mesh;
}

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

/// Closed sphere of latitude and longitude; all triangles share vertices, none is degenerate.
inline TestMesh sphere(float radius, uint32_t rings, uint32_t segments, const glm::vec3& center) {
    TestMesh mesh;
    constexpr double kPi = 3.14159265358979323846;
    const auto point = [&](uint32_t ring, uint32_t segment) {
        const double theta = kPi * ring / rings;
        const double phi = 2.0 * kPi * segment / segments;
        const glm::dvec3 unit(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
        return center + glm::vec3(static_cast<double>(radius) * unit);
    };
    mesh.positions.push_back(center + glm::vec3(0.0f, radius, 0.0f));
    for (uint32_t ring = 1; ring < rings; ++ring)
        for (uint32_t segment = 0; segment < segments; ++segment) mesh.positions.push_back(point(ring, segment));
    mesh.positions.push_back(center - glm::vec3(0.0f, radius, 0.0f));
    const auto south = static_cast<uint32_t>(mesh.positions.size() - 1);
    const auto index = [&](uint32_t ring, uint32_t segment) { return 1 + (ring - 1) * segments + segment % segments; };
    for (uint32_t segment = 0; segment < segments; ++segment) {
        mesh.triangles.emplace_back(0u, index(1, segment + 1), index(1, segment));
        for (uint32_t ring = 1; ring + 1 < rings; ++ring) {
            mesh.triangles.emplace_back(index(ring, segment), index(ring, segment + 1), index(ring + 1, segment));
            mesh.triangles.emplace_back(index(ring, segment + 1), index(ring + 1, segment + 1),
                                        index(ring + 1, segment));
        }
        mesh.triangles.emplace_back(south, index(rings - 1, segment), index(rings - 1, segment + 1));
    }
    return mesh;
}

constexpr const char* kNoDragon = "shared/scenes/stanford-dragon/dragon_vrip.ply is not beside the repository";

/// The Stanford dragon, 871,414 triangles, or nothing where the shared scenes are absent.
inline std::optional<TestMesh> readDragon() {
    const std::filesystem::path path =
        std::filesystem::path(RAYLAB_SOURCE_DIR) / "../shared/scenes/stanford-dragon/dragon_vrip.ply";
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
