// Lights of a shape that are no surfaces: spheres, discs, rectangles, and the sun's disc. Rays see them and pass on.
#ifndef RAYLAB_LIGHT_SHAPES_GLSL
#define RAYLAB_LIGHT_SHAPES_GLSL

#include "lib/sampling.glsl"
#include "lib/scene_buffers.glsl"
#include "trace/common.glsl"

// `pdf`: over solid angle, of a direction that sampleShape draws; 0: there is none.
struct ShapePoint {
    vec3 direction;  // unit, from the receiver
    float distance;
    float pdf;
};

const ShapePoint kNoShapePoint = ShapePoint(vec3(0.0, 1.0, 0.0), 0.0, 0.0);

float pdfCone(float oneMinusCosine) { return 1.0 / (2.0 * kPi * oneMinusCosine); }

// Uniform in the cone about `axis`; 1 - cosine of its angle keeps its digits where the cone is thin.
vec3 sampleCone(vec3 axis, float oneMinusCosine, vec2 u, out float sineSquared) {
    float k = u.x * oneMinusCosine;
    sineSquared = k * (2.0 - k);
    float phi = 2.0 * kPi * u.y, sine = sqrt(sineSquared);
    return frameAround(axis) * vec3(sine * cos(phi), sine * sin(phi), 1.0 - k);
}

// 1 - cosine of half the angle under which a sphere is seen from outside.
float sphereCone(float radius, float distanceSquared) {
    float sineSquared = radius * radius / distanceSquared;
    return sineSquared / (1.0 + sqrt(1.0 - sineSquared));
}

// By the cone that the sphere subtends (Wang, "Physically Correct Direct Lighting for Distribution Ray Tracing", Graphics
// Gems III, 1992). From within it nothing is seen.
ShapePoint sampleSphere(PunctualData light, vec3 position, vec2 u) {
    vec3 toCentre = light.position - position;
    float distanceSquared = dot(toCentre, toCentre), radiusSquared = light.shape.x * light.shape.x;
    if (distanceSquared <= radiusSquared) return kNoShapePoint;
    float distance = sqrt(distanceSquared), cone = sphereCone(light.shape.x, distanceSquared), sineSquared;
    vec3 direction = sampleCone(toCentre / distance, cone, u, sineSquared);
    float halfChord = sqrt(max(0.0, radiusSquared - distanceSquared * sineSquared));
    return ShapePoint(direction, distance * sqrt(1.0 - sineSquared) - halfChord, pdfCone(cone));
}

ShapePoint pointOfArea(vec3 toPoint, vec3 normal, float area) {
    float distanceSquared = dot(toPoint, toPoint), distance = sqrt(distanceSquared);
    float cosLight = -dot(normal, toPoint) / distance;
    return cosLight > 0.0 ? ShapePoint(toPoint / distance, distance, distanceSquared / (cosLight * area)) : kNoShapePoint;
}

ShapePoint sampleDiscLight(PunctualData light, vec3 position, vec2 u) {
    vec2 p = light.shape.x * sampleDisc(u);
    mat3 world = frameAround(light.direction);
    return pointOfArea(light.position + p.x * world[0] + p.y * world[1] - position, light.direction,
                       kPi * light.shape.x * light.shape.x);
}

// A rectangle as a receiver in front of it sees it: corners in its own frame, of which z is minus the receiver's height above.
struct SeenRectangle {
    mat3 frame;  // along the first and the second edge, and the way that its light goes
    vec2 low;
    vec2 high;
    float z;           // negative in front
    float solidAngle;
};

// Solid angle of the triangle of three corners, whose triple product is `volume` (van Oosterom, Strackee, "The Solid Angle of
// a Plane Triangle", IEEE Transactions on Biomedical Engineering 30(2), 1983).
float triangleAngle(vec3 a, vec3 b, vec3 c, float volume) {
    float la = length(a), lb = length(b), lc = length(c);
    return 2.0 * atan(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

SeenRectangle seeRectangle(PunctualData light, vec3 position) {
    vec3 x = normalize(light.direction), y = normalize(light.shape);
    SeenRectangle r;
    r.frame = mat3(x, y, cross(x, y));
    vec3 corner = (light.position - position) * r.frame;
    vec2 size = vec2(length(light.direction), length(light.shape));
    r.low = corner.xy;
    r.high = corner.xy + size;
    r.z = corner.z;
    vec3 opposite = vec3(r.high, r.z);
    float volume = size.x * size.y * abs(r.z);
    r.solidAngle = triangleAngle(corner, vec3(r.high.x, r.low.y, r.z), opposite, volume) +
                   triangleAngle(corner, vec3(r.low.x, r.high.y, r.z), opposite, volume);
    return r;
}

// A smaller solid angle is lost among the angles of the spherical rectangle's corners: then the area serves, over which the
// solid angle hardly varies.
const float kSmallestSolidAngle = 0.01;

// acos() is too rough on lavapipe: at .1 sr samples then fail A15 (p = 3e-8; so, .7).
float angleOf(float cosine) { return atan(sqrt((1.0 - cosine) * (1.0 + cosine)), cosine); }

// Evenly over the solid angle (Urena, Fajardo, King, "An Area-Preserving Parametrization for Spherical Rectangles", EGSR 2013).
// Returns the point in the rectangle's frame.
vec3 pointOfSolidAngle(SeenRectangle r, vec2 u) {
    // z of the normals of the planes through the receiver and the edges, in turn.
    vec4 n = vec4(-r.low.y, r.high.x, r.high.y, -r.low.x);
    n *= inversesqrt(r.z * r.z + n * n);
    float k = 2.0 * kPi - angleOf(-n.z * n.w) - angleOf(-n.w * n.x);
    float angle = u.x * r.solidAngle + k;
    float f = (cos(angle) * n.x - n.z) / sin(angle);
    float c = clamp((f > 0.0 ? 1.0 : -1.0) * inversesqrt(f * f + n.x * n.x), -1.0, 1.0);
    float x = clamp(-c * r.z * inversesqrt(max(1.0 - c * c, 1e-14)), r.low.x, r.high.x);
    float distance = sqrt(x * x + r.z * r.z);
    float h0 = r.low.y / length(vec2(distance, r.low.y)), h1 = r.high.y / length(vec2(distance, r.high.y));
    float h = mix(h0, h1, u.y);
    float y = clamp(h * distance * inversesqrt(max(1.0 - h * h, 1e-14)), r.low.y, r.high.y);
    return vec3(x, y, r.z);
}

ShapePoint sampleRectangle(PunctualData light, vec3 position, vec2 u) {
    SeenRectangle r = seeRectangle(light, position);
    if (r.z >= 0.0) return kNoShapePoint;
    if (r.solidAngle < kSmallestSolidAngle) {
        vec3 normal = cross(light.direction, light.shape);
        float area = length(normal);
        return pointOfArea(light.position + u.x * light.direction + u.y * light.shape - position, normal / area, area);
    }
    vec3 toPoint = r.frame * pointOfSolidAngle(r, u);
    float distance = length(toPoint);
    return ShapePoint(toPoint / distance, distance, 1.0 / r.solidAngle);
}

ShapePoint sampleShape(PunctualData light, vec3 position, vec2 u) {
    if (light.kind == kPunctualSphere) return sampleSphere(light, position, u);
    if (light.kind == kPunctualDisc) return sampleDiscLight(light, position, u);
    if (light.kind == kPunctualRectangle) return sampleRectangle(light, position, u);
    float sineSquared;
    vec3 direction = sampleCone(-light.direction, light.shape.x, u, sineSquared);
    return ShapePoint(direction, kInfinity, pdfCone(light.shape.x));
}

ShapePoint hitSphere(PunctualData light, Ray ray) {
    vec3 toCentre = light.position - ray.origin;
    float distanceSquared = dot(toCentre, toCentre), radiusSquared = light.shape.x * light.shape.x;
    if (distanceSquared <= radiusSquared) return kNoShapePoint;
    float along = dot(toCentre, ray.direction);
    vec3 beside = toCentre - along * ray.direction;
    float chord = radiusSquared - dot(beside, beside);
    if (along <= 0.0 || chord < 0.0) return kNoShapePoint;
    return ShapePoint(ray.direction, along - sqrt(chord), pdfCone(sphereCone(light.shape.x, distanceSquared)));
}

ShapePoint hitPlane(Ray ray, vec3 toPlane, vec3 normal) {
    float cosLight = -dot(normal, ray.direction);
    float t = -dot(normal, toPlane) / cosLight;
    return cosLight > 0.0 && t > 0.0 ? ShapePoint(ray.direction, t, t * t / cosLight) : kNoShapePoint;
}

ShapePoint hitDisc(PunctualData light, Ray ray) {
    ShapePoint at = hitPlane(ray, light.position - ray.origin, light.direction);
    vec3 fromCentre = ray.origin + at.distance * ray.direction - light.position;
    float radiusSquared = light.shape.x * light.shape.x;
    at.pdf = dot(fromCentre, fromCentre) <= radiusSquared ? at.pdf / (kPi * radiusSquared) : 0.0;
    return at;
}

ShapePoint hitRectangle(PunctualData light, Ray ray) {
    vec3 normal = cross(light.direction, light.shape);
    float area = length(normal);
    ShapePoint at = hitPlane(ray, light.position - ray.origin, normal / area);
    vec3 fromCorner = ray.origin + at.distance * ray.direction - light.position;
    vec2 within = vec2(dot(fromCorner, light.direction) / dot(light.direction, light.direction),
                       dot(fromCorner, light.shape) / dot(light.shape, light.shape));
    bool isHit = at.pdf > 0.0 && all(lessThanEqual(abs(within - 0.5), vec2(0.5)));
    float solidAngle = seeRectangle(light, ray.origin).solidAngle;
    at.pdf = isHit ? (solidAngle < kSmallestSolidAngle ? at.pdf / area : 1.0 / solidAngle) : 0.0;
    return at;
}

// Where a ray comes upon the light, and with which density sampleShape draws that direction from the ray's origin.
ShapePoint hitShape(PunctualData light, Ray ray) {
    if (light.kind == kPunctualSphere) return hitSphere(light, ray);
    if (light.kind == kPunctualDisc) return hitDisc(light, ray);
    return hitRectangle(light, ray);
}

// The same of a disc in the sky. The distance of two unit vectors keeps the digits of a small angle.
ShapePoint hitSunDisc(PunctualData light, Ray ray) {
    vec3 apart = ray.direction + light.direction;
    float pdf = dot(apart, apart) <= 2.0 * light.shape.x ? pdfCone(light.shape.x) : 0.0;
    return ShapePoint(ray.direction, kInfinity, pdf);
}

#endif
