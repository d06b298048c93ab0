// Ray-triangle tests, one of which a kernel is specialised to. What a triangle stores for each:
// engine/render/triangle_record.h. All are two-sided and accept tMin < t <= tMax: the caller decides ties.
#ifndef RAYLAB_TRIANGLE_GLSL
#define RAYLAB_TRIANGLE_GLSL

const uint kWordsTraceTriangle = kTriangleTest == kTrianglePrecomputed || kTriangleTest == kTriangleBaldwinWeber ? 4u : 3u;

// A ray as the tests want it.
struct TriangleRay {
    vec3 origin;
    vec3 direction;
    vec3 shear;  // sx, sy, sz: of the watertight test
    uint axis;   // largest component of the direction
};

vec3 permute(vec3 v, uint axis) { return axis == 2u ? v : (axis == 1u ? v.zxy : v.yzx); }

TriangleRay triangleRay(vec3 origin, vec3 direction) {
    vec3 a = abs(direction);
    uint axis = a.x > a.y ? (a.x > a.z ? 0u : 2u) : (a.y > a.z ? 1u : 2u);
    vec3 d = permute(direction, axis);
    return TriangleRay(origin, direction, vec3(d.xy, 1.0) / d.z, axis);
}

// A triangle's words: three vectors and, for some tests, a fourth.
struct TriangleWords {
    vec3 a;
    vec3 b;
    vec3 c;
    vec3 d;
};

// Where the ray meets the triangle's plane. Woop et al. take the mean of the vertices' distances by the edge functions, which rounds to
// u L^2 / h (u = 2^-24, L the longest edge, h its height): 6e-4 on a plane of 1e4, whichever way it faces. This rounds to 4 u R along the
// normal, R the distance to a vertex, and as the normal does: docs/stability.md. The sign of the normal drops out. Edge-on nothing
// is left of it, hence no nearer and no farther than the vertices, at `distances`.
float planeDistance(TriangleRay ray, TriangleWords triangle, vec3 distances) {
    vec3 normal = cross(triangle.b - triangle.a, triangle.c - triangle.a);
    float slope = dot(normal, ray.direction);
    float low = min(min(distances.x, distances.y), distances.z);
    float high = max(max(distances.x, distances.y), distances.z);
    float t = dot(normal, triangle.a - ray.origin) / slope;
    return slope != 0.0 ? min(max(t, low), high) : low;
}

// Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013, over the vertices.
// `precise` keeps the edge functions of two triangles that share an edge exactly opposite: no contraction to FMA. Adding
// zero turns -0 into 0, so that signs can be told from the bits.
bool intersectWatertight(TriangleRay ray, TriangleWords triangle, out float t, out vec2 uv) {
    vec3 a = permute(triangle.a - ray.origin, ray.axis);
    vec3 b = permute(triangle.b - ray.origin, ray.axis);
    vec3 c = permute(triangle.c - ray.origin, ray.axis);
    precise vec2 as = a.xy - ray.shear.xy * a.z;
    precise vec2 bs = b.xy - ray.shear.xy * b.z;
    precise vec2 cs = c.xy - ray.shear.xy * c.z;
    precise float u0 = cs.x * bs.y;
    precise float u1 = cs.y * bs.x;
    precise float v0 = as.x * cs.y;
    precise float v1 = as.y * cs.x;
    precise float w0 = bs.x * as.y;
    precise float w1 = bs.y * as.x;
    precise float u = u0 - u1 + 0.0;
    precise float v = v0 - v1 + 0.0;
    precise float w = w0 - w1 + 0.0;
    ivec3 signs = floatBitsToInt(vec3(u, v, w));
    bool inside = min(signs.x, min(signs.y, signs.z)) >= 0 || max(signs.x, max(signs.y, signs.z)) <= 0;
    float det = u + v + w;
    uv = vec2(v, w) * (1.0 / det);
    t = planeDistance(ray, triangle, vec3(a.z, b.z, c.z) * ray.shear.z);
    return inside && det != 0.0;
}

// Moller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", JGT 2(1), 1997, over the vertices.
bool intersectMinimal(TriangleRay ray, TriangleWords triangle, out float t, out vec2 uv) {
    vec3 edge1 = triangle.b - triangle.a;
    vec3 edge2 = triangle.c - triangle.a;
    vec3 p = cross(ray.direction, edge2);
    float det = dot(edge1, p);
    float inverse = 1.0 / det;
    vec3 s = ray.origin - triangle.a;
    vec3 q = cross(s, edge1);
    uv = vec2(dot(s, p), dot(ray.direction, q)) * inverse;
    t = dot(edge2, q) * inverse;
    return det != 0.0 && uv.x >= 0.0 && uv.y >= 0.0 && uv.x + uv.y <= 1.0;
}

// The same with the edges and the normal edge1 x edge2 stored: a vertex, edge1, edge2, the normal.
bool intersectPrecomputed(TriangleRay ray, TriangleWords triangle, out float t, out vec2 uv) {
    vec3 s = triangle.a - ray.origin;
    vec3 r = cross(ray.direction, s);
    float det = dot(triangle.d, ray.direction);
    float inverse = 1.0 / det;
    uv = vec2(-dot(triangle.c, r), dot(triangle.b, r)) * inverse;
    t = dot(triangle.d, s) * inverse;
    return det != 0.0 && uv.x >= 0.0 && uv.y >= 0.0 && uv.x + uv.y <= 1.0;
}

// Baldwin, Weber, "Fast Ray-Triangle Intersections by Coordinate Transformation", JCGT 5(3), 2016: the rows of a matrix
// that takes the triangle to (0,0,0), (1,0,0), (0,1,0), and its translation.
bool intersectBaldwinWeber(TriangleRay ray, TriangleWords triangle, out float t, out vec2 uv) {
    float originZ = dot(triangle.c, ray.origin) + triangle.d.z;
    float directionZ = dot(triangle.c, ray.direction);
    t = -originZ / directionZ;
    vec3 p = ray.origin + t * ray.direction;
    uv = vec2(dot(triangle.a, p), dot(triangle.b, p)) + triangle.d.xy;
    return directionZ != 0.0 && uv.x >= 0.0 && uv.y >= 0.0 && uv.x + uv.y <= 1.0;
}

// t and the barycentric weights of the second and third vertex.
bool intersectTriangle(TriangleRay ray, TriangleWords triangle, float tMin, float tMax, out float t, out vec2 uv) {
    bool inside;
    if (kTriangleTest == kTriangleMinimal)
        inside = intersectMinimal(ray, triangle, t, uv);
    else if (kTriangleTest == kTrianglePrecomputed)
        inside = intersectPrecomputed(ray, triangle, t, uv);
    else if (kTriangleTest == kTriangleBaldwinWeber)
        inside = intersectBaldwinWeber(ray, triangle, t, uv);
    else
        inside = intersectWatertight(ray, triangle, t, uv);
    return inside && t > tMin && t <= tMax;
}

#endif
