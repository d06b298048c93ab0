#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/measure/scaling.h"

namespace raylab {
namespace {

using Key = std::array<float, 3>;
using Edge = std::pair<Key, Key>;

Key keyOf(const glm::vec3& p) { return {p.x, p.y, p.z}; }

TEST(Scaling, CaveIsClosedAroundItsCamera) {
    const Scene scene = makeCave(1000);
    const Mesh& mesh = scene.meshes.at(0);
    std::map<Edge, int> edges;
    double solidAngle = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const Key a = keyOf(mesh.positions[t[i]]), b = keyOf(mesh.positions[t[(i + 1) % 3]]);
            ++edges[{std::min(a, b), std::max(a, b)}];
        }
        // Van Oosterom and Strackee 1983: of a triangle as seen from the camera.
        glm::dvec3 p[3];
        for (int i = 0; i < 3; ++i)
            p[i] = glm::normalize(glm::dvec3(mesh.positions[t[i]]) - glm::dvec3(scene.cameras.at(0).position));
        solidAngle += 2.0 * std::atan2(glm::dot(p[0], glm::cross(p[1], p[2])),
                                       1.0 + glm::dot(p[0], p[1]) + glm::dot(p[1], p[2]) + glm::dot(p[2], p[0]));
    }
    for (const auto& [edge, count] : edges) EXPECT_EQ(count, 2);
    EXPECT_NEAR(solidAngle, -4.0 * 3.14159265358979, 1e-3);
}

TEST(Scaling, CaveHasAboutAsManyTrianglesAsAskedFor) {
    for (const size_t wanted : {size_t{1000}, size_t{100'000}})
        EXPECT_NEAR(static_cast<double>(makeCave(wanted).meshes.at(0).triangles.size()), static_cast<double>(wanted),
                    0.05 * static_cast<double>(wanted));
}

TEST(Scaling, FitFindsItsOwnLogarithm) {
    const std::vector<double> x{1e3, 1e4, 1e5, 1e6};
    std::vector<double> y;
    for (const double value : x) y.push_back(7.0 + 3.0 * std::log2(value));
    const LogarithmicFit fit = fitLogarithm(x, y);
    EXPECT_NEAR(fit.constant, 7.0, 1e-9);
    EXPECT_NEAR(fit.perDoubling, 3.0, 1e-10);
    EXPECT_NEAR(fit.rSquared, 1.0, 1e-12);
}

TEST(Scaling, FitOfALineIsWorse) {
    const std::vector<double> x{1e3, 1e4, 1e5, 1e6}, y{1e3, 1e4, 1e5, 1e6};
    EXPECT_LT(fitLogarithm(x, y).rSquared, 0.7);
}

}  // namespace
}  // namespace raylab
