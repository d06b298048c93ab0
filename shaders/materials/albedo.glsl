// What GGX reflects of light from one direction (engine/render/directional_albedo.h), and what a surface under a rough coat or a
// metal makes of it.
#ifndef RAYLAB_ALBEDO_GLSL
#define RAYLAB_ALBEDO_GLSL

#include "lib/convert.glsl"
#include "lib/sampling.glsl"
#include "lib/scene_buffers.glsl"

// Place in the table along one axis: the cell, and what is left.
void albedoCell(float at, out float cell, out float within) {
    at = sqrt(clamp(at, 0.0, 1.0)) * float(kAlbedoCells);
    cell = min(floor(at), float(kAlbedoCells) - 1.0);
    within = at - cell;
}

// Directional albedo of microfacets of reflectance 1, and (1 - cos)^5. Off by .005 at most, by 3e-4 in the mean.
vec2 ggxAlbedo(float cosTheta, float alpha) {
    vec2 cell, within;
    albedoCell(cosTheta, cell.x, within.x);
    albedoCell(alpha, cell.y, within.y);
    uvec4 w = texelFetch(albedoWords, wholeToInt(cell.y * float(kAlbedoCells) + cell.x));
    return mix(mix(unpackUnorm2x16(w.x), unpackUnorm2x16(w.y), within.x),
               mix(unpackUnorm2x16(w.z), unpackUnorm2x16(w.w), within.x), within.y);
}

// Its mean over the cosine-weighted hemisphere: exactly that of what ggxAlbedo() interpolates.
vec2 ggxAverageAlbedo(float alpha) {
    float cell, within;
    albedoCell(alpha, cell, within);
    uvec2 w = texelFetch(albedoWords, wholeToInt(cell) + int(kAlbedoCells * kAlbedoCells)).xy;
    return mix(unpackUnorm2x16(w.x), unpackUnorm2x16(w.y), within);
}

// Directional albedo of white sheen; the cells lie behind those of GGX where a material has any.
float sheenAlbedo(float cosTheta, float roughness) {
    vec2 cell, within;
    albedoCell(cosTheta, cell.x, within.x);
    albedoCell(roughness * roughness, cell.y, within.y);
    int at = wholeToInt(cell.y * float(kAlbedoCells) + cell.x) + int((kAlbedoCells + 1u) * kAlbedoCells);
    uvec2 w = texelFetch(albedoWords, at).xy;
    vec2 rows = mix(vec2(unpackUnorm2x16(w.x).x, unpackUnorm2x16(w.y).x), vec2(unpackUnorm2x16(w.x).y, unpackUnorm2x16(w.y).y),
                    within.x);
    return kMostSheenAlbedo * mix(rows.x, rows.y, within.y);
}

// Of microfacets whose reflectance is Schlick's: `albedo` by ggxAlbedo() or ggxAverageAlbedo().
vec3 schlickAlbedo(vec3 f0, float f90, vec2 albedo) { return f0 * (albedo.x - albedo.y) + vec3(f90 * albedo.y); }

// Share of the light left over by the first scattering that comes out after more: the first bounce and each later one
// reflect the mean of Schlick's reflectance, and a share `average` of what is reflected again comes out (Kulla, Conty,
// "Revisiting Physically Based Shading at Imageworks", SIGGRAPH course, 2017; squared as by Hill, "A Multi-Faceted
// Exploration", 2018).
vec3 multipleScattering(vec3 f0, float f90, float average) {
    vec3 f = f0 + (vec3(f90) - f0) / 21.0;
    return f * f * average / (1.0 - f * (1.0 - average));
}

#endif
