// Smooth boundary of two dielectrics: exact Fresnel reflectance, Snell's law; or a thin sheet with both of its faces.
#ifndef RAYLAB_DIELECTRIC_GLSL
#define RAYLAB_DIELECTRIC_GLSL

// Unpolarised reflectance. `eta`: index on the far side over index on wo's side; cosTheta >= 0. `cosT`: 0 where all
// light is reflected.
float fresnelDielectric(float cosTheta, float eta, out float cosT) {
    float sin2T = (1.0 - cosTheta * cosTheta) / (eta * eta);
    cosT = 0.0;
    if (sin2T >= 1.0) return 1.0;
    cosT = sqrt(1.0 - sin2T);
    float parallel = (eta * cosTheta - cosT) / (eta * cosTheta + cosT);
    float perpendicular = (cosTheta - eta * cosT) / (cosTheta + eta * cosT);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

// All bounces inside a thin sheet, added up: R + T R T + ... = 2R / (1 + R).
float thinReflectance(float r) { return 2.0 * r / (1.0 + r); }

#endif
