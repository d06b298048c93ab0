#include "engine/render/triangle_record.h"

#include <cmath>

#include "engine/core/error.h"

namespace raylab {
namespace {

constexpr std::array kTests = {
    TriangleTestInfo{"minimal", "Moller-Trumbore over the vertices", 3},
    TriangleTestInfo{"precomputed", "Moller-Trumbore with edges and normal stored", 4},
    TriangleTestInfo{"baldwin-weber", "a matrix that takes the triangle to the unit triangle", 4},
    TriangleTestInfo{"watertight", "Woop, Benthin and Wald: no ray passes between neighbours", 3},
};

struct Vectors {
    glm::vec3 a, b, c, d;
};

Vectors precomputed(const shared::TraceTriangle& t) {
    const glm::dvec3 p0(t.p0), edge1 = glm::dvec3(t.p1) - p0, edge2 = glm::dvec3(t.p2) - p0;
    return {t.p0, glm::vec3(edge1), glm::vec3(edge2), glm::vec3(glm::cross(edge1, edge2))};
}

/// Baldwin and Weber 2016, section 3: the normal's largest component tells the axis that is not needed to invert.
Vectors baldwinWeber(const shared::TraceTriangle& t) {
    const glm::dvec3 p0(t.p0), e1 = glm::dvec3(t.p1) - p0, e2 = glm::dvec3(t.p2) - p0;
    const glm::dvec3 n = glm::cross(e1, e2);
    const glm::dvec3 size = glm::abs(n);
    const int k = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    glm::dvec3 row0(0.0), row1(0.0), row2 = n / n[k];
    row0[i] = e2[j] / n[k];
    row0[j] = -e2[i] / n[k];
    row1[i] = -e1[j] / n[k];
    row1[j] = e1[i] / n[k];
    const glm::dvec3 translation(-glm::dot(row0, p0), -glm::dot(row1, p0), -glm::dot(row2, p0));
    return {glm::vec3(row0), glm::vec3(row1), glm::vec3(row2), glm::vec3(translation)};
}

Vectors vectorsFor(uint32_t test, const shared::TraceTriangle& t) {
    if (test == shared::kTrianglePrecomputed) return precomputed(t);
    if (test == shared::kTriangleBaldwinWeber) return baldwinWeber(t);
    return {t.p0, t.p1, t.p2, glm::vec3(0.0f)};
}

}  // namespace

std::span<const TriangleTestInfo> triangleTests() { return kTests; }

std::vector<std::string> triangleTestNames() {
    std::vector<std::string> names;
    for (const TriangleTestInfo& info : kTests) names.emplace_back(info.name);
    return names;
}

uint32_t findTriangleTest(std::string_view name) {
    for (uint32_t i = 0; i < kTests.size(); ++i)
        if (kTests[i].name == name) return i;
    throw Error("there is no triangle test '" + std::string(name) + "'");
}

std::array<glm::uvec4, 4> packTriangle(uint32_t test, const shared::TraceTriangle& triangle) {
    const bool isQuadric = (triangle.instance & shared::kSlotIsQuadric) != 0;
    const Vectors v = vectorsFor(isQuadric ? shared::kTriangleMinimal : test, triangle);
    const auto word = [](const glm::vec3& xyz, uint32_t w) { return glm::uvec4(glm::floatBitsToUint(xyz), w); };
    return {word(v.a, triangle.instance), word(v.b, triangle.primitive), word(v.c, triangle.opacity), word(v.d, 0)};
}

}  // namespace raylab
