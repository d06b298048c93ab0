#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace raylab::assets {

/// Indexed triangles, counter-clockwise seen from outside. The three per-vertex arrays are equally long. Metres.
/// Unless a function says otherwise, one unit of uv is one metre on the surface, so that a texture's size in metres is
/// a matter of scaleUvs().
struct Geometry {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<glm::uvec3> triangles;
};

/// An outline as smooth stretches, each a row of points; consecutive stretches meet in a sharp edge.
using Profile = std::vector<std::vector<glm::vec2>>;

/// Appends `part`, moved by `transform` (rotation, translation and any scale; mirroring turns the triangles round).
void append(Geometry& whole, const Geometry& part, const glm::mat4& transform = glm::mat4(1.0f));

void scaleUvs(Geometry& geometry, glm::vec2 factor);

/// uv = two coordinates of the position along the oblique unit axes `uAxis`, `vAxis`: a texture that runs through the
/// solid.
void projectUvs(Geometry& geometry, glm::vec3 uAxis, glm::vec3 vAxis);

/// Area-weighted vertex normals from the triangles.
void smoothNormals(Geometry& geometry);

/// A quadrilateral a, b, c, d, counter-clockwise from outside, with uv from `uvA` (a) to `uvC` (c).
void appendQuad(Geometry& whole, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, glm::vec2 uvA, glm::vec2 uvC);

Geometry box(glm::vec3 low, glm::vec3 high);

/// Triangles between two rows of `count` vertices that start at `lower` and `upper`; those without area (at a pole) are
/// left out. Outside is where `lower` runs to the right below `upper`.
void stitchRows(Geometry& g, uint32_t lower, uint32_t upper, uint32_t count);

/// A vertex grid of (columns + 1) x (rows + 1) points from `point(u, v)`, u and v in [0, 1], with smooth normals and
/// uv = (u, v). Outside is the side from which u grows to the right and v upwards.
template <typename Point>
Geometry parametricSurface(uint32_t columns, uint32_t rows, Point&& point);

/// Solid of revolution about +Y. Profile points are (radius, height), from the bottom up for an outer surface.
/// A radius of 0 closes the pole.
Geometry lathe(const Profile& profile, uint32_t segments);

/// The same profile around a rectangle: points are (distance outwards from the rectangle, height); corners are mitred.
Geometry rectangularLathe(const Profile& profile, glm::vec2 halfExtent);

/// A profile of (z, y) points swept along X from -length/2 to length/2. No caps.
Geometry sweepAlongX(const Profile& profile, float length);

/// A tube of radius `radii[i]` along `path`, ends closed by points where their radius is 0.
Geometry tube(std::span<const glm::vec3> path, std::span<const float> radii, uint32_t segments);

/// Latitude-longitude sphere; uv covers [0, 1]^2.
Geometry sphere(float radius, uint32_t segments, uint32_t rings);

/// Torus about +Y with an elliptic cross-section: `halfWidth` radially, `halfHeight` along Y.
Geometry torus(float radius, float halfWidth, float halfHeight, uint32_t segments, uint32_t sides);

/// A straight stretch of a profile.
std::vector<glm::vec2> line(glm::vec2 a, glm::vec2 b);

/// A smooth stretch of a profile: points on a circular arc about `centre`, angles in degrees from +x towards +y.
std::vector<glm::vec2> profileArc(glm::vec2 centre, float radius, float fromDegrees, float toDegrees, uint32_t steps);

/// Catmull-Rom curve through `knots` (two or more), `steps` points a span.
template <typename Vector>
std::vector<Vector> catmullRom(const std::vector<Vector>& knots, int steps);

/// Translation, rotation about +Y in degrees, and scale, in glTF's order T * R * S.
glm::mat4 place(glm::vec3 position, float yawDegrees = 0.0f, glm::vec3 scale = glm::vec3(1.0f));

template <typename Point>
Geometry parametricSurface(uint32_t columns, uint32_t rows, Point&& point) {
    Geometry g;
    for (uint32_t j = 0; j <= rows; ++j) {
        for (uint32_t i = 0; i <= columns; ++i) {
            const glm::vec2 uv(static_cast<float>(i) / static_cast<float>(columns),
                               static_cast<float>(j) / static_cast<float>(rows));
            g.positions.push_back(point(uv.x, uv.y));
            g.uvs.push_back(uv);
        }
    }
    for (uint32_t j = 0; j < rows; ++j) stitchRows(g, j * (columns + 1), (j + 1) * (columns + 1), columns + 1);
    smoothNormals(g);
    return g;
}

template <typename Vector>
std::vector<Vector> catmullRom(const std::vector<Vector>& knots, int steps) {
    const int spans = static_cast<int>(knots.size()) - 1;
    const auto knot = [&](int i) { return knots[static_cast<size_t>(glm::clamp(i, 0, spans))]; };
    std::vector<Vector> points;
    for (int i = 0; i < steps * spans; ++i) {
        const int k = i / steps;
        const float t = static_cast<float>(i % steps) / static_cast<float>(steps);
        const Vector a = knot(k - 1);
        const Vector b = knot(k);
        const Vector c = knot(k + 1);
        const Vector d = knot(k + 2);
        points.push_back(0.5f * (2.0f * b + (c - a) * t + (2.0f * a - 5.0f * b + 4.0f * c - d) * t * t +
                                 (3.0f * b - a - 3.0f * c + d) * t * t * t));
    }
    points.push_back(knots.back());
    return points;
}

}  // namespace raylab::assets
