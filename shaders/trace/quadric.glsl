// Ray-quadric test (engine/scene/quadric.h): both roots are tried against the clip planes, near one first.
#ifndef RAYLAB_QUADRIC_GLSL
#define RAYLAB_QUADRIC_GLSL

#include "lib/quadric_uv.glsl"

struct CanonicalQuadric {
    vec4 row0, row1, row2;  // of the matrix from the space of its tree
    float zz, z, constant;
    float clipLow, clipHigh;
    bool isEllipsoid;
};

CanonicalQuadric loadQuadric(uint quadric) {
    int at = int(quadric * kWordsTraceQuadric);
    vec4 form = uintBitsToFloat(texelFetch(traceQuadricWords, at + 3));
    uvec4 rest = texelFetch(traceQuadricWords, at + 4);
    return CanonicalQuadric(uintBitsToFloat(texelFetch(traceQuadricWords, at)),
                            uintBitsToFloat(texelFetch(traceQuadricWords, at + 1)),
                            uintBitsToFloat(texelFetch(traceQuadricWords, at + 2)), form.x, form.y, form.z, form.w,
                            uintBitsToFloat(rest.x), rest.y != 0u);
}

vec3 canonicalPoint(CanonicalQuadric q, vec3 point) {
    vec4 h = vec4(point, 1.0);
    return vec3(dot(q.row0, h), dot(q.row1, h), dot(q.row2, h));
}

vec2 canonicalUv(CanonicalQuadric q, vec3 point) {
    return quadricUv(point, q.isEllipsoid, q.clipHigh, q.clipHigh - q.clipLow);
}

// Texture coordinates at a point in the space of the quadric's tree.
vec2 quadricUvAt(vec3 point, uint quadric) {
    CanonicalQuadric q = loadQuadric(quadric);
    return canonicalUv(q, canonicalPoint(q, point));
}

// t with tMin < t <= tMax, and texture coordinates. `origin` and `direction` in the space of the tree.
// The origin is moved to the closest approach to the centre before the equation is set up, and the smaller root is taken
// from the product of the two: Haines, Guenther, Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray
// Tracing Gems, chapter 7, 2019; for the other kinds the same holds.
bool intersectQuadric(vec3 origin, vec3 direction, uint quadric, float tMin, float tMax, out float t, out vec2 uv) {
    CanonicalQuadric q = loadQuadric(quadric);
    vec3 o = canonicalPoint(q, origin);
    vec3 d = vec3(dot(q.row0.xyz, direction), dot(q.row1.xyz, direction), dot(q.row2.xyz, direction));
    float shift = -dot(o, d) / dot(d, d);
    o += shift * d;
    vec3 oz = vec3(o.xy, q.zz * o.z);
    float a = dot(d.xy, d.xy) + q.zz * d.z * d.z;
    float halfB = dot(oz, d) + 0.5 * q.z * d.z;
    float c = dot(oz, o) + q.z * o.z + q.constant;
    float discriminant = halfB * halfB - a * c;
    float root = sqrt(max(discriminant, 0.0));
    float larger = -(halfB + (halfB < 0.0 ? -root : root));
    // Where there is one root alone the other is infinite or not a number, and never accepted.
    float t0 = larger / a, t1 = c / larger;
    bool ordered = t0 < t1;
    vec2 roots = ordered ? vec2(t0, t1) : vec2(t1, t0);
    vec2 distances = shift + roots;
    vec2 heights = o.z + roots * d.z;
    bvec2 within = bvec2(distances.x > tMin && distances.x <= tMax && heights.x >= q.clipLow && heights.x <= q.clipHigh,
                         distances.y > tMin && distances.y <= tMax && heights.y >= q.clipLow && heights.y <= q.clipHigh);
    t = within.x ? distances.x : distances.y;
    uv = canonicalUv(q, o + (within.x ? roots.x : roots.y) * d);
    return discriminant >= 0.0 && (within.x || within.y);
}

#endif
