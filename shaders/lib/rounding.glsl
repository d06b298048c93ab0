// Bounds of what rounding does to a hit.
#ifndef RAYLAB_ROUNDING_GLSL
#define RAYLAB_ROUNDING_GLSL

#include "lib/sampling.glsl"

const float kMachineEpsilon = 5.9604644775390625e-8;
float roundingBound(int operations) {
    return float(operations) * kMachineEpsilon / (1.0 - float(operations) * kMachineEpsilon);
}

// How far rounding goes on a triangle, and where a hit on it has to be because of that.
struct Roundings {
    float distance;  // bound of the error of the distance at which it, or a coplanar neighbour, would be hit again
    vec3 inset;      // to add to the position
};

// Drivers' tests take t as a mean of the vertices' distances by edge functions, whose products round in proportion to the square
// of the length: over the area, that is the length over the height. Ours errs less (planeDistance() in trace/triangle.glsl), but
// paths are to be the same on all tracers. No further than the triangle is high.
// A hit beside an edge may be rounded to a place beyond it, behind the wall that stands there: it is moved inwards, in the
// plane, until it is as far from each edge as the position and the wall's distance may be wrong, or a quarter of the
// triangle's height above it where that is less. In units of the longest edge, whose square may overflow.
Roundings triangleRoundings(vec3 edge1, vec3 edge2, vec2 b, vec3 positionError) {
    float longest = max(maxComponent(abs(edge1)), maxComponent(abs(edge2)));
    float bound = roundingBound(4);
    edge1 /= longest;
    edge2 /= longest;
    vec3 edge0 = edge2 - edge1, across = cross(edge1, edge2);
    float twiceArea = length(across);
    Roundings r;
    r.distance = longest * max(bound, min(bound / twiceArea, twiceArea));
    vec3 lengths = vec3(length(edge0), length(edge2), length(edge1));
    vec3 heights = twiceArea / lengths;
    vec3 room = min(vec3(bound + maxComponent(positionError) / longest), 0.25 * heights);
    vec3 shift = longest * max(room - vec3(1.0 - b.x - b.y, b) * heights, 0.0) / (twiceArea * lengths);
    r.inset = shift.x * cross(across, edge0) - shift.y * cross(across, edge2) + shift.z * cross(across, edge1);
    return r;
}

#endif
