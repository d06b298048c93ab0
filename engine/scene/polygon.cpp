#include "engine/scene/polygon.h"

#include <algorithm>
#include <cmath>

namespace raylab {
namespace {

/// Ear clipping takes cubic time in the worst case; a polygon as large as this is cut as a fan.
constexpr size_t kMostEars = 4096;

double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Projected along the largest axis of the normal, counter-clockwise.
std::vector<glm::dvec2> flattened(std::span<const uint32_t> corners, std::span<const glm::vec3> positions) {
    glm::dvec3 normal(0.0);
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = positions[corners[i]];
        const glm::dvec3 b = positions[corners[(i + 1) % corners.size()]];
        normal += glm::cross(a - glm::dvec3(positions[corners[0]]), b - glm::dvec3(positions[corners[0]]));
    }
    int drop = std::abs(normal.y) > std::abs(normal.x) ? 1 : 0;
    if (std::abs(normal.z) > std::abs(normal[drop])) drop = 2;
    const int u = (drop + 1) % 3, v = (drop + 2) % 3;
    std::vector<glm::dvec2> points;
    for (const uint32_t corner : corners) {
        const glm::dvec3 p = positions[corner];
        points.push_back(normal[drop] < 0.0 ? glm::dvec2(p[v], p[u]) : glm::dvec2(p[u], p[v]));
    }
    return points;
}

bool isConvex(std::span<const glm::dvec2> points) {
    for (size_t i = 0; i < points.size(); ++i)
        if (turn(points[i], points[(i + 1) % points.size()], points[(i + 2) % points.size()]) < 0.0) return false;
    return true;
}

/// Whether the triangle at `ear` of the remaining outline can be cut off: convex, and no other corner inside or on it.
bool isEar(std::span<const glm::dvec2> points, std::span<const size_t> outline, size_t ear) {
    const size_t n = outline.size();
    const glm::dvec2 a = points[outline[(ear + n - 1) % n]], b = points[outline[ear]],
                     c = points[outline[(ear + 1) % n]];
    if (turn(a, b, c) <= 0.0) return false;
    return std::none_of(outline.begin(), outline.end(), [&](size_t other) {
        const glm::dvec2 p = points[other];
        return p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    });
}

void appendFan(std::span<const uint32_t> corners, std::span<const size_t> outline, std::vector<glm::uvec3>& triangles) {
    for (size_t i = 1; i + 1 < outline.size(); ++i)
        triangles.emplace_back(corners[outline[0]], corners[outline[i]], corners[outline[i + 1]]);
}

}  // namespace

void triangulatePolygon(std::span<const uint32_t> corners, std::span<const glm::vec3> positions,
                        std::vector<glm::uvec3>& triangles) {
    std::vector<size_t> outline(corners.size());
    for (size_t i = 0; i < outline.size(); ++i) outline[i] = i;
    const std::vector<glm::dvec2> points = flattened(corners, positions);
    if (corners.size() <= kMostEars && !isConvex(points)) {
        for (size_t ear = 0; outline.size() > 3 && ear < outline.size();) {
            const size_t n = outline.size();
            if (!isEar(points, outline, ear)) {
                ++ear;
                continue;
            }
            triangles.emplace_back(corners[outline[(ear + n - 1) % n]], corners[outline[ear]],
                                   corners[outline[(ear + 1) % n]]);
            outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(ear));
            ear = 0;
        }
    }
    appendFan(corners, outline, triangles);
}

}  // namespace raylab
