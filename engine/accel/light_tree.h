#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/accel/aabb.h"

namespace raylab {

/// Directions into which lights send: the normals lie within thetaO of the axis, and light leaves up to thetaE from a
/// normal. Radians.
struct EmissionCone {
    glm::dvec3 axis{0.0, 0.0, 1.0};  ///< unit
    double thetaO = 0.0;
    double thetaE = 0.0;
};

/// The smallest cone around both, but for rounding (Conty Estevez, Kulla 2018, algorithm 1).
EmissionCone uniteCones(EmissionCone a, EmissionCone b);

/// What a choice knows of a light, or of several.
struct LightBound {
    Aabb box;
    EmissionCone cone;
    double power = 0.0;       ///< radiance x area of a lamp, or radiant intensity: luminance over distance^2 at a point
    bool isTwoSided = false;  ///< sends the same against the axis
};

/// Two nodes side by side: the children of one node, or of the root.
struct LightNode {
    LightBound bound;
    uint32_t reference = 0;  ///< a light, or the pair of its children
    bool isLeaf = false;
};

/// A binary tree with one light in each leaf. nodes[2k] and nodes[2k + 1] are pair k; pair 0 is the root's. trails[i]
/// is the way to light i: bit j says which child is next at depth j, and a 1 stands above the last bit.
struct LightTree {
    Aabb box;
    std::vector<LightNode> nodes;
    std::vector<uint32_t> trails;
};

/// Builds top down by the surface area orientation heuristic over bins: Conty Estevez, Kulla, "Importance Sampling of
/// Many Lights with Adaptive Tree Splitting", PACM CGIT 1(2), 2018, section 4. No way is longer than 31 steps. Lights
/// without power may be among them. Needs two lights or more; at most 2^30.
LightTree buildLightTree(std::span<const LightBound> lights);

}  // namespace raylab
