// One light of many, by a binary tree of bounds: Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree
// Splitting", PACM CGIT 1(2), 2018, without its splitting. At each node a random number goes to one child, in proportion to
// a bound of what the child sends to the point. A light that cannot reach the point is never chosen.
#ifndef RAYLAB_LIGHT_TREE_GLSL
#define RAYLAB_LIGHT_TREE_GLSL

#include "lib/sampling.glsl"
#include "lib/scene_buffers.glsl"

layout(set = 0, binding = kBindLightNodes) uniform usamplerBuffer lightNodeWords;
layout(set = 0, binding = kBindLightTrails) uniform usamplerBuffer lightTrails;

layout(constant_id = kSpecLightTree) const uint kLightTree = 0;

// Where light is asked for. A normal of 0: from all around, as where the surface lets light through.
struct Receiver {
    vec3 position;
    vec3 normal;
};

struct LightPair {
    uvec2 left;  // reference, flags
    uvec2 right;
    float leftShare;  // probability of the left one; negative: nothing of the pair reaches the receiver
};

// A number of 24 bits is used up after so many choices: then comes a second one.
const uint kChoicesPerNumber = 12u;

// cos and sin of max(0, a - b).
float cosDifference(float sinA, float cosA, float sinB, float cosB) { return cosA > cosB ? 1.0 : cosA * cosB + sinA * sinB; }
float sinDifference(float sinA, float cosA, float sinB, float cosB) { return cosA > cosB ? 0.0 : sinA * cosB - cosA * sinB; }
float sineOf(float cosine) { return sqrt(max(0.0, 1.0 - cosine * cosine)); }

LightNodeData loadLightNode(uint node) {
    int at = int(node * kWordsLightNode);
    uvec4 a = texelFetch(lightNodeWords, at);
    uvec4 b = texelFetch(lightNodeWords, at + 1);
    return LightNodeData(a.x, a.y, a.z, a.w, uintBitsToFloat(b.x), b.y, b.z, b.w);
}

// Bound of what the node's lights send to the receiver: power over the squared distance, by the smallest angles that their
// normals and the receiver's can make (section 4.1 of the paper). u: half the angle under which the node's sphere is seen.
float lightImportance(LightNodeData node, Receiver receiver) {
    vec2 xy = vec2(node.loXY & 0xffffu, node.loXY >> 16), zx = vec2(node.loZhiX & 0xffffu, node.loZhiX >> 16);
    vec2 yz = vec2(node.hiYZ & 0xffffu, node.hiYZ >> 16);
    vec3 lo = vec3(xy, zx.x) * frame.lightGridStep, hi = vec3(zx.y, yz) * frame.lightGridStep;
    vec3 toNode = frame.lightGridOrigin + 0.5 * (lo + hi) - receiver.position;
    float distanceSquared = dot(toNode, toNode), radiusSquared = 0.25 * dot(hi - lo, hi - lo);
    bool isInside = distanceSquared <= radiusSquared;
    vec3 direction = toNode * inversesqrt(max(distanceSquared, 1e-30));
    float cosU = isInside ? -1.0 : sqrt(1.0 - radiusSquared / distanceSquared), sinU = sineOf(cosU);

    vec2 cosines = unpackSnorm2x16(node.cosines);
    float cosAxis = -dot(decodeNormal(node.axis), direction);
    if ((node.flags & kLightNodeTwoSided) != 0u) cosAxis = abs(cosAxis);
    float sinAxis = sineOf(cosAxis), sinO = sineOf(cosines.x);
    float cosX = cosDifference(sinAxis, cosAxis, sinO, cosines.x), sinX = sinDifference(sinAxis, cosAxis, sinO, cosines.x);
    float cosEmitted = cosDifference(sinX, cosX, sinU, cosU);
    if (cosEmitted < cosines.y) return 0.0;

    float cosReceiver = dot(receiver.normal, direction);
    float cosReceived = receiver.normal == vec3(0.0) ? 1.0 : cosDifference(sineOf(cosReceiver), cosReceiver, sinU, cosU);
    return max(0.0, node.power * cosEmitted * max(0.0, cosReceived) / max(distanceSquared, max(radiusSquared, 1e-30)));
}

LightPair lightPair(uint pair, Receiver receiver) {
    LightNodeData left = loadLightNode(2u * pair), right = loadLightNode(2u * pair + 1u);
    float ofLeft = lightImportance(left, receiver);
    float sum = ofLeft + lightImportance(right, receiver);
    return LightPair(uvec2(left.reference, left.flags), uvec2(right.reference, right.flags),
                     sum > 0.0 ? ofLeft / sum : -1.0);
}

// A light by two numbers in [0, 1), and the probability of it; 0: none reaches the receiver, or the choice came to a node
// none of whose lights does.
uint chooseLight(Receiver receiver, vec2 choice, out float probability) {
    probability = 1.0;
    uint pair = 0u;
    for (uint depth = 0u;; ++depth) {
        if (depth == kChoicesPerNumber) choice.x = choice.y;
        LightPair children = lightPair(pair, receiver);
        if (children.leftShare < 0.0) {
            probability = 0.0;
            return 0u;
        }
        bool isLeft = choice.x < children.leftShare;
        float share = isLeft ? children.leftShare : 1.0 - children.leftShare;
        choice.x = min((isLeft ? choice.x : choice.x - children.leftShare) / share, 0.99999994);
        probability *= share;
        uvec2 next = isLeft ? children.left : children.right;
        if ((next.y & kLightNodeLeaf) != 0u) return next.x;
        pair = next.x;
    }
}

// Probability with which chooseLight comes to the light at the end of `trail` (engine/accel/light_tree.h).
float lightProbability(Receiver receiver, uint trail) {
    float probability = trail == 0u ? 0.0 : 1.0;
    uint pair = 0u;
    while (trail > 1u && probability > 0.0) {
        LightPair children = lightPair(pair, receiver);
        bool isLeft = (trail & 1u) == 0u;
        probability *= children.leftShare < 0.0 ? 0.0 : (isLeft ? children.leftShare : 1.0 - children.leftShare);
        pair = isLeft ? children.left.x : children.right.x;
        trail >>= 1;
    }
    return probability;
}

#endif
