// Watertight ray-triangle test: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
// `precise` keeps the edge functions of two triangles that share an edge exactly opposite: no contraction to FMA.
#ifndef RAYLAB_TRIANGLE_GLSL
#define RAYLAB_TRIANGLE_GLSL

struct ShearedRay {
    vec3 origin;
    vec3 shear;  // sx, sy, sz
    uint axis;   // largest component of the direction
};

vec3 permute(vec3 v, uint axis) { return axis == 2u ? v : (axis == 1u ? v.zxy : v.yzx); }

ShearedRay shearRay(vec3 origin, vec3 direction) {
    vec3 a = abs(direction);
    uint axis = a.x > a.y ? (a.x > a.z ? 0u : 2u) : (a.y > a.z ? 1u : 2u);
    vec3 d = permute(direction, axis);
    return ShearedRay(origin, vec3(d.xy, 1.0) / d.z, axis);
}

// t and the barycentric weights of p1 and p2; two-sided. Accepts tMin < t <= tMax: the caller decides ties.
bool intersectTriangle(ShearedRay ray, vec3 p0, vec3 p1, vec3 p2, float tMin, float tMax, out float t, out vec2 uv) {
    vec3 a = permute(p0 - ray.origin, ray.axis);
    vec3 b = permute(p1 - ray.origin, ray.axis);
    vec3 c = permute(p2 - ray.origin, ray.axis);
    precise vec2 as = a.xy - ray.shear.xy * a.z;
    precise vec2 bs = b.xy - ray.shear.xy * b.z;
    precise vec2 cs = c.xy - ray.shear.xy * c.z;
    precise float u0 = cs.x * bs.y;
    precise float u1 = cs.y * bs.x;
    precise float v0 = as.x * cs.y;
    precise float v1 = as.y * cs.x;
    precise float w0 = bs.x * as.y;
    precise float w1 = bs.y * as.x;
    precise float u = u0 - u1;
    precise float v = v0 - v1;
    precise float w = w0 - w1;
    bool inside = min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0;
    float det = u + v + w;
    float inverse = 1.0 / det;
    t = (u * a.z + v * b.z + w * c.z) * ray.shear.z * inverse;
    uv = vec2(v, w) * inverse;
    return inside && det != 0.0 && t > tMin && t <= tMax;
}

#endif
