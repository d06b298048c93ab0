// The opaque base of metallic-roughness: a metal, or a Lambertian below a dielectric coat.
#ifndef RAYLAB_BASE_GLSL
#define RAYLAB_BASE_GLSL

#include "materials/facets.glsl"
#include "materials/lambert.glsl"

vec3 diffuseAlbedo(Surface s) { return s.baseColor * (1.0 - s.metallic); }

// Reflectance at normal and at grazing incidence: of the dielectric coat, and of coat and metal.
vec3 coatReflectance0(Surface s) {
    float r0 = (s.ior - 1.0) / (s.ior + 1.0);
    if (!needs(kNeedSpecularTint)) return vec3(s.specular * r0 * r0);
    return s.specular * min(r0 * r0 * s.lobes.specularColor, vec3(1.0));
}
vec3 reflectance0(Surface s) { return mix(coatReflectance0(s), s.baseColor, s.metallic); }
float reflectance90(Surface s) { return mix(s.specular, 1.0, s.metallic); }

// A coat that lets nothing through has nothing below it.
const float kLeastUnder = 1e-4;

// Share of light that enters the dielectric coat, in the channel that enters least. What comes from the base through it is
// the product of the shares of both directions over their mean: reciprocal, and all that the coat does not reflect reaches
// the base (Kelemen, Szirmay-Kalos, "A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling",
// Eurographics 2001).
float coatTransmittance(Surface s, vec2 albedo, float averageOne) {
    vec3 f0 = vec3(maxComponent(coatReflectance0(s)));
    float reflected = schlickAlbedo(f0, s.specular, albedo).x;
    if (kEnergy == kEnergyMultiple) reflected += (1.0 - albedo.x) * multipleScattering(f0, s.specular, averageOne).x;
    return 1.0 - reflected;
}

// What is known of the base once wo is.
struct Base {
    vec3 diffuse;  // albedo, of the Lambertian alone
    vec3 f0;
    float f90;
    float under;     // share of the light that reaches the Lambertian, and over that of all directions
    vec3 multiple;   // share of the light scattered more than once, over what makes it a density
    float specularShare;  // probability of drawing from the microfacets
    float albedo;         // about what the base scatters
};

Base baseOf(Surface s, float cosO) {
    Base base = Base(diffuseAlbedo(s), vec3(0.0), 0.0, 1.0, vec3(0.0), 0.0, 0.0);
    base.albedo = maxComponent(base.diffuse);
    if (!needs(kNeedSpecular)) return base;
    base.f0 = reflectance0(s);
    base.f90 = reflectance90(s);
    vec2 albedo = facetAlbedo(cosO, s.alpha), average = facetAverageAlbedo(s.alpha);
    float entering = coatTransmittance(s, albedo, average.x);
    base.under = entering / max(coatTransmittance(s, average, average.x), kLeastUnder);
    float scattered = maxComponent(base.diffuse) * entering;
    if (kEnergy == kEnergyMultiple && !isSmooth(s)) {
        vec3 again = (1.0 - albedo.x) * multipleScattering(base.f0, base.f90, average.x);
        base.multiple = again * kInvPi / max(1.0 - average.x, kLeastUnder);
        scattered += maxComponent(again);
    }
    float reflected = maxComponent(schlickAlbedo(base.f0, base.f90, albedo));
    base.albedo = reflected + scattered;
    float share = reflected > 0.0 ? reflected / base.albedo : 0.0;
    base.specularShare = share > 0.0 ? clamp(share, 0.1, scattered > 0.0 ? 0.9 : 1.0) : 0.0;
    return base;
}

// Of what spreads over the hemisphere: the Lambertian below its coat, and light scattered more than once.
vec3 evalBroad(Surface s, Base base, float cosI) {
    vec3 value = evalLambert(base.diffuse);
    if (!needs(kNeedSpecular)) return value;
    vec2 albedo = facetAlbedo(cosI, s.alpha);
    value *= base.under * coatTransmittance(s, albedo, kEnergy == kEnergyMultiple ? facetAverageAlbedo(s.alpha).x : 0.0);
    return value + (1.0 - albedo.x) * base.multiple;
}

// f of the base without a mirror's, and the density of what is drawn from it: both directions above the surface.
vec3 evalBase(Surface s, Base base, vec3 wo, vec3 wi, out float pdf) {
    float cosO = dot(wo, s.normal), cosI = dot(wi, s.normal);
    vec3 value = evalBroad(s, base, cosI);
    pdf = (1.0 - base.specularShare) * pdfCosineHemisphere(cosI);
    if (needs(kNeedSpecular) && !isSmooth(s)) {
        vec3 h = normalize(wo + wi);
        Facets facets = facetsAt(s, wo, wi, h);
        value += fresnelSchlick(base.f0, base.f90, dot(wo, h)) * evalFacetReflection(facets, cosO, cosI);
        pdf += base.specularShare * pdfFacetReflection(facets, cosO);
    }
    return value;
}

#endif
