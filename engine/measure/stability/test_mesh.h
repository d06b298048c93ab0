#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <vector>

/// Meshes for measurements of traversals, made in code, the same for the same seed.
namespace raylab::stability {

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

}  // namespace raylab::stability
