// The microfacets of a surface's base: GGX, of one roughness or of two.
#ifndef RAYLAB_FACETS_GLSL
#define RAYLAB_FACETS_GLSL

#include "lib/surface.glsl"
#include "materials/albedo.glsl"
#include "materials/ggx.glsl"

// A mirror direction can't be connected to a light.
bool isSmooth(Surface s) { return s.alpha < kSmallestAlpha; }

// Columns: tangent, bitangent, normal.
mat3 shadingFrame(Surface s) {
    if (needs(kNeedAnisotropy)) return mat3(s.tangent, cross(s.normal, s.tangent), s.normal);
    return frameAround(s.normal);
}

vec2 facetAlpha(Surface s) { return vec2(needs(kNeedAnisotropy) ? s.alphaTangent : s.alpha, s.alpha); }

vec3 sampleFacet(Surface s, mat3 world, vec3 wo, vec2 u) { return world * sampleGgxNormal(wo * world, facetAlpha(s), u); }

// Density of normals about h, and Smith's function of both directions, whichever side wi is on.
struct Facets {
    float distribution;
    float lambdaO;
    float lambdaI;
};

Facets facetsAt(Surface s, vec3 wo, vec3 wi, vec3 h) {
    if (needs(kNeedAnisotropy)) {
        mat3 world = shadingFrame(s);
        vec2 alpha = facetAlpha(s);
        return Facets(ggxDistribution(h * world, alpha), ggxLambda(wo * world, alpha), ggxLambda(wi * world, alpha));
    }
    return Facets(ggxDistribution(dot(h, s.normal), s.alpha), ggxLambda(dot(wo, s.normal), s.alpha),
                  ggxLambda(dot(wi, s.normal), s.alpha));
}

// D G / (4 cosO cosI), to be multiplied by the Fresnel term.
float evalFacetReflection(Facets f, float cosO, float cosI) {
    return f.distribution / ((1.0 + f.lambdaO + f.lambdaI) * 4.0 * cosO * cosI);
}

// Density of the mirrored direction where the normal is drawn by sampleFacet().
float pdfFacetReflection(Facets f, float cosO) { return f.distribution / (4.0 * cosO * (1.0 + f.lambdaO)); }

// Directional albedos (materials/albedo.glsl), and their mean. Of two roughnesses the smaller counts: more is taken for
// reflected than is, so that what lies below never makes up for light that was not lost.
vec2 facetAlbedo(float cosTheta, float alpha) {
    return alpha < kSmallestAlpha ? vec2(1.0, fresnelSchlick(vec3(0.0), 1.0, cosTheta).x) : ggxAlbedo(cosTheta, alpha);
}
vec2 facetAverageAlbedo(float alpha) { return alpha < kSmallestAlpha ? vec2(1.0, 1.0 / 21.0) : ggxAverageAlbedo(alpha); }

#endif
