#pragma once

#include "assets/generate/mesh_tools.h"

namespace raylab::assets {

// The statue in the proportions of a woman of 1.75 m: y from the sole of the standing foot, facing +Z, her left is +X.

/// Body, drapery and rock as one distance field (negative inside, Lipschitz bound kFigureLipschitz). Built once,
/// then asked from many threads.
class Figure {
public:
    Figure();
    float distance(glm::vec3 p) const;

private:
    struct Strand {
        std::vector<glm::vec3> path;
        float fromRadius;
        float toRadius;
    };
    float legs(glm::vec3 p) const;
    float clothedLegs(glm::vec3 p) const;
    float torso(glm::vec3 p) const;
    float clothedTorso(glm::vec3 p) const;
    float wingArms(glm::vec3 p) const;
    float skirt(glm::vec3 p, float toLegs) const;
    float strands(glm::vec3 p) const;
    float mantle(glm::vec3 p) const;
    float rock(glm::vec3 p) const;

    std::vector<Strand> strands_;
    std::vector<glm::vec3> mantlePath_;
    std::vector<glm::vec3> bone_;
};
constexpr float kFigureLipschitz = 1.7f;
constexpr float kGround = -0.16f;  ///< underside of the rock

/// Feathers of one wing; `side` is +1 for her left, -1 for her right. Closed overlapping solids.
Geometry wing(float side);

/// The wing's bone from shoulder blade to wrist, which Figure fleshes out: four points.
std::vector<glm::vec3> wingBone(float side);

}  // namespace raylab::assets
