#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/accel/light_tree.h"
#include "engine/core/luminance.h"
#include "engine/render/gpu_data.h"

namespace raylab {
namespace {

using std::numbers::pi;

constexpr int kGridLast = 65535;
/// Added to the angle of a cone: what rounding its axis to 2 x 16 bits can turn it by.
constexpr double kAxisRounding = 1e-4;

LightBound boundOf(const shared::EmissiveData& triangle, double emitted, bool isTwoSided) {
    LightBound bound;
    for (const glm::vec3 corner : {triangle.p0, triangle.p0 + triangle.edge1, triangle.p0 + triangle.edge2})
        bound.box.grow(corner);
    const glm::dvec3 normal = glm::cross(glm::dvec3(triangle.edge1), glm::dvec3(triangle.edge2));
    const double twiceArea = glm::length(normal);
    bound.isTwoSided = isTwoSided;
    if (!(twiceArea > 0.0)) return bound;  // lost by rounding to floats
    bound.cone = {normal * (static_cast<double>(triangle.frontSign) / twiceArea), 0.0, 0.5 * pi};
    bound.power = emitted * 0.5 * twiceArea;
    return bound;
}

LightBound boundOfShape(const shared::PunctualData& light) {
    LightBound bound;
    bound.cone.axis = glm::dvec3(light.direction);
    bound.cone.thetaE = 0.5 * pi;
    if (light.kind == shared::kPunctualRectangle) {
        for (const glm::vec3 corner : {glm::vec3(0.0f), light.direction, light.shape, light.direction + light.shape})
            bound.box.grow(light.position + corner);
        const glm::dvec3 normal = glm::cross(glm::dvec3(light.direction), glm::dvec3(light.shape));
        bound.cone.axis = glm::normalize(normal);
        bound.power = luminance(light.intensity) * glm::length(normal);
        return bound;
    }
    const float radius = light.shape.x;
    const bool isSphere = light.kind == shared::kPunctualSphere;
    const glm::vec3 n = isSphere ? glm::vec3(0.0f) : light.direction;
    const glm::vec3 reach = radius * glm::sqrt(glm::max(1.0f - n * n, glm::vec3(0.0f)));
    bound.box = {light.position - reach, light.position + reach};
    if (isSphere) bound.cone.thetaO = pi;
    bound.power = luminance(light.intensity) * pi * static_cast<double>(radius) * static_cast<double>(radius);
    return bound;
}

/// Point and spot lights: the same in all directions of the cone.
LightBound boundOf(const shared::PunctualData& light) {
    if (light.kind >= shared::kPunctualSphere) return boundOfShape(light);
    LightBound bound;
    bound.box.grow(light.position);
    bound.power = luminance(light.intensity);
    bound.cone.axis = glm::dvec3(light.direction);
    bound.cone.thetaO = pi;
    if (light.kind == shared::kPunctualSpot)
        bound.cone.thetaO = std::acos(std::clamp(-static_cast<double>(light.shape.y / light.shape.x), -1.0, 1.0));
    return bound;
}

/// Steps of the grid over the tree's box, which the nodes' boxes are rounded outwards on.
class LightGrid {
public:
    explicit LightGrid(const Aabb& box) {
        for (int i = 0; i < 3; ++i) {
            origin[i] = std::nextafter(box.lo[i], -std::numeric_limits<float>::infinity());
            const double extent = static_cast<double>(box.hi[i]) - static_cast<double>(origin[i]);
            step[i] = static_cast<float>(extent * (1.0 + 1e-6) / kGridLast);
        }
    }
    uint32_t below(float x, int axis) const {
        return static_cast<uint32_t>(std::clamp(std::floor(at(x, axis)), 0.0, 1.0 * kGridLast));
    }
    uint32_t above(float x, int axis) const {
        return static_cast<uint32_t>(std::clamp(std::ceil(at(x, axis)), 0.0, 1.0 * kGridLast));
    }

    glm::vec3 origin{}, step{};

private:
    double at(float x, int axis) const {
        return (static_cast<double>(x) - static_cast<double>(origin[axis])) / static_cast<double>(step[axis]);
    }
};

uint32_t snormBelow(double value) {
    const auto bits = static_cast<int32_t>(std::floor(std::clamp(value, -1.0, 1.0) * 32767.0));
    return static_cast<uint32_t>(bits) & 0xffffu;
}

shared::LightNodeData packNode(const LightNode& node, const LightGrid& grid) {
    const LightBound& b = node.bound;
    shared::LightNodeData data{};
    data.loXY = grid.below(b.box.lo.x, 0) | grid.below(b.box.lo.y, 1) << 16;
    data.loZhiX = grid.below(b.box.lo.z, 2) | grid.above(b.box.hi.x, 0) << 16;
    data.hiYZ = grid.above(b.box.hi.y, 1) | grid.above(b.box.hi.z, 2) << 16;
    data.axis = encodeNormal(glm::vec3(b.cone.axis));
    data.power = static_cast<float>(b.power);
    const double thetaO = std::min(b.cone.thetaO + kAxisRounding, pi);
    data.cosines = snormBelow(std::cos(thetaO)) | snormBelow(std::cos(b.cone.thetaE)) << 16;
    data.reference = node.reference;
    data.flags = (node.isLeaf ? shared::kLightNodeLeaf : 0u) | (b.isTwoSided ? shared::kLightNodeTwoSided : 0u);
    return data;
}

/// The trail and the area of each triangle of the instances that emit, found by instance and primitive. Degenerate
/// ones, which no ray hits, have none.
void packTrails(const Scene& scene, const LightTree& tree, LightTables& lights) {
    lights.firstTrail.assign(scene.instances.size(), 0);
    for (uint32_t i = 0; i < lights.shapedCount; ++i)
        lights.trails.push_back({tree.trails[lights.emissive.size() + i], 0.0f});
    size_t next = 0;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const size_t first = lights.trails.size();
        lights.firstTrail[i] = static_cast<uint32_t>(first);
        for (; next < lights.emissive.size() && lights.emissive[next].instance == i; ++next) {
            const shared::EmissiveData& triangle = lights.emissive[next];
            const double area = 0.5 * glm::length(glm::cross(glm::dvec3(triangle.edge1), glm::dvec3(triangle.edge2)));
            lights.trails.resize(first + triangle.primitive + 1, {0, 0.0f});
            if (area > 0.0) lights.trails.back() = {tree.trails[next], static_cast<float>(1.0 / area)};
        }
    }
}

}  // namespace

void packLightTree(const Scene& scene, std::span<const float> emitted, LightTables& lights) {
    std::vector<LightBound> bounds;
    for (const shared::EmissiveData& triangle : lights.emissive)
        bounds.push_back(boundOf(triangle, static_cast<double>(emitted[triangle.material]),
                                 scene.materials[triangle.material].doubleSided));
    for (const shared::PunctualData& light : lights.punctual)
        if (light.kind != shared::kPunctualDirectional && light.kind != shared::kPunctualSunDisc)
            bounds.push_back(boundOf(light));
    const LightTree tree = buildLightTree(bounds);
    const LightGrid grid(tree.box);
    lights.gridOrigin = grid.origin;
    lights.gridStep = grid.step;
    for (const LightNode& node : tree.nodes) lights.nodes.push_back(packNode(node, grid));
    packTrails(scene, tree, lights);
}

}  // namespace raylab
