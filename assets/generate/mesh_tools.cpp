#include "assets/generate/mesh_tools.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace raylab::assets {
namespace {

constexpr float kTau = glm::two_pi<float>();

/// Normal of a profile at point i of a stretch: to the right of the way the profile runs.
glm::vec2 profileNormal(const std::vector<glm::vec2>& stretch, size_t i) {
    const glm::vec2 before = stretch[i == 0 ? 0 : i - 1];
    const glm::vec2 after = stretch[i + 1 == stretch.size() ? i : i + 1];
    const glm::vec2 along = after - before;
    return glm::normalize(glm::vec2(along.y, -along.x));
}

/// Runs a profile through `row(point, normal, arcLength)`, which appends one row of `rowLength` vertices.
template <typename Row>
void sweepProfile(Geometry& g, const Profile& profile, uint32_t rowLength, Row&& row) {
    float arcLength = 0.0f;
    for (const std::vector<glm::vec2>& stretch : profile) {
        for (size_t i = 0; i < stretch.size(); ++i) {
            if (i > 0) arcLength += glm::distance(stretch[i - 1], stretch[i]);
            const auto start = static_cast<uint32_t>(g.positions.size());
            row(stretch[i], profileNormal(stretch, i), arcLength);
            if (i > 0) stitchRows(g, start - rowLength, start, rowLength);
        }
    }
}

float meanRadius(const Profile& profile) {
    float sum = 0.0f;
    float count = 0.0f;
    for (const auto& stretch : profile) {
        for (const glm::vec2& point : stretch) {
            sum += point.x;
            count += 1.0f;
        }
    }
    return sum / count;
}

}  // namespace

void stitchRows(Geometry& g, uint32_t lower, uint32_t upper, uint32_t count) {
    const auto add = [&g](uint32_t a, uint32_t b, uint32_t c) {
        const glm::vec3 areaVector = glm::cross(g.positions[b] - g.positions[a], g.positions[c] - g.positions[a]);
        if (glm::length(areaVector) > 1e-12f) g.triangles.emplace_back(a, b, c);
    };
    for (uint32_t i = 0; i + 1 < count; ++i) {
        add(lower + i, lower + i + 1, upper + i + 1);
        add(lower + i, upper + i + 1, upper + i);
    }
}

void append(Geometry& whole, const Geometry& part, const glm::mat4& transform) {
    const auto base = static_cast<uint32_t>(whole.positions.size());
    const glm::mat3 linear(transform);
    const glm::mat3 normalMatrix = glm::transpose(glm::inverse(linear));
    const bool mirrored = glm::determinant(linear) < 0.0f;
    for (size_t i = 0; i < part.positions.size(); ++i) {
        whole.positions.emplace_back(transform * glm::vec4(part.positions[i], 1.0f));
        whole.normals.push_back(glm::normalize(normalMatrix * part.normals[i]));
        whole.uvs.push_back(part.uvs[i]);
    }
    for (glm::uvec3 t : part.triangles) {
        if (mirrored) std::swap(t.y, t.z);
        whole.triangles.push_back(t + base);
    }
}

void scaleUvs(Geometry& geometry, glm::vec2 factor) {
    for (glm::vec2& uv : geometry.uvs) uv *= factor;
}

void projectUvs(Geometry& geometry, glm::vec3 uAxis, glm::vec3 vAxis) {
    for (size_t i = 0; i < geometry.positions.size(); ++i) {
        geometry.uvs[i] = {glm::dot(geometry.positions[i], uAxis), glm::dot(geometry.positions[i], vAxis)};
    }
}

void smoothNormals(Geometry& geometry) {
    geometry.normals.assign(geometry.positions.size(), glm::vec3(0.0f));
    for (const glm::uvec3& t : geometry.triangles) {
        const glm::vec3 a = geometry.positions[t.x];
        const glm::vec3 areaVector = glm::cross(geometry.positions[t.y] - a, geometry.positions[t.z] - a);
        for (const uint32_t corner : {t.x, t.y, t.z}) geometry.normals[corner] += areaVector;
    }
    for (glm::vec3& n : geometry.normals) {
        const float length = glm::length(n);
        n = length > 0.0f ? n / length : glm::vec3(0.0f, 1.0f, 0.0f);
    }
}

void appendQuad(Geometry& whole, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, glm::vec2 uvA, glm::vec2 uvC) {
    const auto base = static_cast<uint32_t>(whole.positions.size());
    const glm::vec3 n = glm::normalize(glm::cross(c - a, d - b));
    whole.positions.insert(whole.positions.end(), {a, b, c, d});
    whole.normals.insert(whole.normals.end(), 4, n);
    whole.uvs.insert(whole.uvs.end(), {uvA, {uvC.x, uvA.y}, uvC, {uvA.x, uvC.y}});
    whole.triangles.emplace_back(base, base + 1, base + 2);
    whole.triangles.emplace_back(base, base + 2, base + 3);
}

Geometry box(glm::vec3 l, glm::vec3 h) {
    Geometry g;
    appendQuad(g, {l.x, l.y, h.z}, {h.x, l.y, h.z}, h, {l.x, h.y, h.z}, {l.x, -l.y}, {h.x, -h.y});
    appendQuad(g, {h.x, l.y, l.z}, l, {l.x, h.y, l.z}, {h.x, h.y, l.z}, {-h.x, -l.y}, {-l.x, -h.y});
    appendQuad(g, {h.x, l.y, h.z}, {h.x, l.y, l.z}, {h.x, h.y, l.z}, h, {-h.z, -l.y}, {-l.z, -h.y});
    appendQuad(g, l, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z}, {l.z, -l.y}, {h.z, -h.y});
    appendQuad(g, {l.x, h.y, h.z}, h, {h.x, h.y, l.z}, {l.x, h.y, l.z}, {l.x, h.z}, {h.x, l.z});
    appendQuad(g, l, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z}, {l.x, l.z}, {h.x, h.z});
    return g;
}

Geometry lathe(const Profile& profile, uint32_t segments) {
    Geometry g;
    const float girth = kTau * meanRadius(profile);
    sweepProfile(g, profile, segments + 1, [&](glm::vec2 point, glm::vec2 normal, float arcLength) {
        for (uint32_t i = 0; i <= segments; ++i) {
            const float turn = static_cast<float>(i) / static_cast<float>(segments);
            const float angle = i == segments ? 0.0f : kTau * turn;
            const glm::vec3 radial(std::sin(angle), 0.0f, std::cos(angle));
            g.positions.push_back(point.x * radial + glm::vec3(0.0f, point.y, 0.0f));
            g.normals.push_back(normal.x * radial + glm::vec3(0.0f, normal.y, 0.0f));
            g.uvs.emplace_back(girth * turn, -arcLength);
        }
    });
    return g;
}

Geometry rectangularLathe(const Profile& profile, glm::vec2 halfExtent) {
    Geometry g;
    for (int side = 0; side < 4; ++side) {
        const bool alongX = side % 2 == 0;
        const float halfLength = alongX ? halfExtent.x : halfExtent.y;
        const float distance = alongX ? halfExtent.y : halfExtent.x;
        Geometry face;
        sweepProfile(face, profile, 2, [&](glm::vec2 point, glm::vec2 normal, float arcLength) {
            const float reach = halfLength + point.x;
            for (const float x : {-reach, reach}) {
                face.positions.emplace_back(x, point.y, distance + point.x);
                face.normals.emplace_back(0.0f, normal.y, normal.x);
                face.uvs.emplace_back(x, -arcLength);
            }
        });
        append(g, face, place(glm::vec3(0.0f), 90.0f * static_cast<float>(side)));
    }
    return g;
}

Geometry sweepAlongX(const Profile& profile, float length) {
    Geometry g;
    sweepProfile(g, profile, 2, [&](glm::vec2 point, glm::vec2 normal, float arcLength) {
        for (const float x : {-0.5f * length, 0.5f * length}) {
            g.positions.emplace_back(x, point.y, point.x);
            g.normals.emplace_back(0.0f, normal.y, normal.x);
            g.uvs.emplace_back(x, -arcLength);
        }
    });
    return g;
}

Geometry tube(std::span<const glm::vec3> path, std::span<const float> radii, uint32_t segments) {
    Geometry g;
    glm::vec3 side(1.0f, 0.0f, 0.0f);
    float arcLength = 0.0f;
    for (size_t i = 0; i < path.size(); ++i) {
        const glm::vec3 before = path[i == 0 ? 0 : i - 1];
        const glm::vec3 after = path[i + 1 == path.size() ? i : i + 1];
        const glm::vec3 along = glm::normalize(after - before);
        if (std::abs(glm::dot(side, along)) > 0.95f) side = glm::vec3(0.0f, 0.0f, 1.0f);
        side = glm::normalize(side - glm::dot(side, along) * along);
        const glm::vec3 up = glm::cross(along, side);
        if (i > 0) arcLength += glm::distance(path[i - 1], path[i]);
        const auto start = static_cast<uint32_t>(g.positions.size());
        for (uint32_t k = 0; k <= segments; ++k) {
            const float turn = static_cast<float>(k) / static_cast<float>(segments);
            const float angle = k == segments ? 0.0f : kTau * turn;
            const glm::vec3 radial = std::cos(angle) * side + std::sin(angle) * up;
            g.positions.push_back(path[i] + radii[i] * radial);
            g.normals.push_back(radial);
            g.uvs.emplace_back(kTau * radii[0] * turn, -arcLength);
        }
        if (i > 0) stitchRows(g, start - segments - 1, start, segments + 1);
    }
    return g;
}

Geometry sphere(float radius, uint32_t segments, uint32_t rings) {
    Geometry g = lathe({profileArc({0.0f, 0.0f}, radius, -90.0f, 90.0f, rings)}, segments);
    for (size_t i = 0; i < g.positions.size(); ++i) {
        g.normals[i] = glm::normalize(g.positions[i]);
        g.uvs[i] = {static_cast<float>(i % (segments + 1)) / static_cast<float>(segments),
                    1.0f - static_cast<float>(i / (segments + 1)) / static_cast<float>(rings)};
    }
    return g;
}

Geometry torus(float radius, float halfWidth, float halfHeight, uint32_t segments, uint32_t sides) {
    std::vector<glm::vec2> section;
    for (uint32_t i = 0; i <= sides; ++i) {
        const float angle = i == sides ? 0.0f : kTau * static_cast<float>(i) / static_cast<float>(sides);
        section.emplace_back(radius + halfWidth * std::cos(angle), halfHeight * std::sin(angle));
    }
    return lathe({section}, segments);
}

std::vector<glm::vec2> line(glm::vec2 a, glm::vec2 b) { return {a, b}; }

std::vector<glm::vec2> profileArc(glm::vec2 centre, float radius, float fromDegrees, float toDegrees, uint32_t steps) {
    std::vector<glm::vec2> points;
    for (uint32_t i = 0; i <= steps; ++i) {
        const float degrees = glm::mix(fromDegrees, toDegrees, static_cast<float>(i) / static_cast<float>(steps));
        const float angle = glm::radians(degrees);
        glm::vec2 direction(std::cos(angle), std::sin(angle));
        if (std::abs(direction.x) < 1e-6f) direction.x = 0.0f;
        points.push_back(centre + radius * direction);
    }
    return points;
}

glm::mat4 place(glm::vec3 position, float yawDegrees, glm::vec3 scale) {
    const glm::mat4 translated = glm::translate(glm::mat4(1.0f), position);
    return glm::scale(glm::rotate(translated, glm::radians(yawDegrees), glm::vec3(0.0f, 1.0f, 0.0f)), scale);
}

}  // namespace raylab::assets
