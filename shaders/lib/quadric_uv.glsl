// Texture coordinates of a quadric: u around the axis from +X towards +Y, v from the upper end down. An ellipsoid's v is its
// latitude, so that clip planes do not move the texture; the others' is the height between the planes.
#ifndef RAYLAB_QUADRIC_UV_GLSL
#define RAYLAB_QUADRIC_UV_GLSL

#include "lib/sampling.glsl"

// `p`: canonical.
vec2 quadricUv(vec3 p, bool isEllipsoid, float clipHigh, float height) {
    float turn = p.xy == vec2(0.0) ? 0.0 : atan(p.y, p.x) / (2.0 * kPi);
    float v = isEllipsoid ? atan(length(p.xy), p.z) / kPi : (clipHigh - p.z) / height;
    return vec2(turn < 0.0 ? turn + 1.0 : turn, v);
}

// Derivatives by u and v, canonical. At a pole, where there are none, those by u are zero.
void quadricDerivatives(vec3 p, bool isEllipsoid, float zz, float z, float height, out vec3 byU, out vec3 byV) {
    byU = 2.0 * kPi * vec3(-p.y, p.x, 0.0);
    float section = dot(p.xy, p.xy);
    float inverse = section > 0.0 ? 1.0 / section : 0.0;
    float radius = sqrt(section);
    vec3 byLatitude = kPi * vec3(p.z * p.xy * sqrt(inverse), -radius);
    vec3 byHeight = vec3(-(zz * p.z + 0.5 * z) * inverse * p.xy, 1.0);
    byV = isEllipsoid ? byLatitude : -height * byHeight;
}

#endif
