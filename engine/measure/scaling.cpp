#include "engine/measure/scaling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace raylab {
namespace {

constexpr int kFaces = 6;
constexpr int kOctaves = 6;
constexpr float kAmplitude = 0.12f;  ///< of the first octave; each further one has half of the one before

/// Distance of the wall from the origin in a unit direction.
float wallDistance(const glm::vec3& direction) {
    float distance = 1.0f;
    float amplitude = kAmplitude, frequency = 2.0f;
    for (int octave = 0; octave < kOctaves; ++octave) {
        const glm::vec3 p = direction * frequency + glm::vec3(1.3f, 2.1f, 0.7f) * static_cast<float>(octave);
        distance +=
            amplitude * std::sin(p.x + std::sin(p.y)) * std::sin(p.y + std::sin(p.z)) * std::sin(p.z + std::sin(p.x));
        amplitude *= 0.5f;
        frequency *= 2.1f;
    }
    return distance;
}

/// A point of the cube [-1, 1]^3: u and v in [-1, 1] on face 0 .. 5, counter-clockwise as seen from within.
glm::vec3 cubePoint(int face, float u, float v) {
    const float w = face % 2 == 0 ? 1.0f : -1.0f;
    if (w > 0.0f) std::swap(u, v);
    const int axis = face / 2;
    return axis == 0 ? glm::vec3(w, u, v) : axis == 1 ? glm::vec3(v, w, u) : glm::vec3(u, v, w);
}

}  // namespace

Scene makeCave(size_t triangles) {
    const double squares = static_cast<double>(triangles) / (2.0 * kFaces);
    const auto n = static_cast<uint32_t>(std::max(1.0, std::round(std::sqrt(squares))));
    const uint32_t row = n + 1;
    Mesh mesh;
    mesh.positions.resize(size_t{kFaces} * row * row);
    mesh.triangles.resize(size_t{kFaces} * n * n * 2);
    tbb::parallel_for(uint32_t{0}, kFaces * row, [&](uint32_t line) {
        const int face = static_cast<int>(line / row);
        const uint32_t y = line % row;
        for (uint32_t x = 0; x < row; ++x) {
            const auto at = [&](uint32_t i) { return 2.0f * static_cast<float>(i) / static_cast<float>(n) - 1.0f; };
            const glm::vec3 direction = glm::normalize(cubePoint(face, at(x), at(y)));
            mesh.positions[size_t{line} * row + x] = direction * wallDistance(direction);
            if (x == n || y == n) continue;
            const uint32_t a = line * row + x;
            const size_t first = ((static_cast<size_t>(face) * n + y) * n + x) * 2;
            mesh.triangles[first] = {a, a + 1, a + row + 1};
            mesh.triangles[first + 1] = {a, a + row + 1, a + row};
        }
    });
    Scene scene;
    scene.name = "cave of " + std::to_string(mesh.triangles.size()) + " triangles";
    scene.materials.emplace_back();
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({});
    scene.cameras.push_back({"inside", {0.3f, 0.1f, 0.4f}, {-0.5f, -0.1f, -0.6f}, {0.0f, 1.0f, 0.0f}, 1.2f});
    return scene;
}

LogarithmicFit fitLogarithm(std::span<const double> x, std::span<const double> y) {
    assert(x.size() == y.size() && x.size() >= 2);
    const auto count = static_cast<double>(x.size());
    double meanX = 0.0, meanY = 0.0;
    for (size_t i = 0; i < x.size(); ++i) {
        meanX += std::log2(x[i]) / count;
        meanY += y[i] / count;
    }
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (size_t i = 0; i < x.size(); ++i) {
        const double dx = std::log2(x[i]) - meanX, dy = y[i] - meanY;
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
    }
    assert(xx > 0.0);
    const double slope = xy / xx;
    return {meanY - slope * meanX, slope, yy > 0.0 ? xy * slope / yy : 1.0};
}

}  // namespace raylab
