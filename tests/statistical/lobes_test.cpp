#include <cmath>
#include <cstdio>
#include <functional>

#include "engine/render/directional_albedo.h"
#include "tests/support/draw_bsdf.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// The lobes under a white sky (A14) and where there are closed forms, against double precision.
namespace raylab::support {
namespace {

using Lobes = GpuTest;

/// A floor of the material under a white sky; below it is white too. Negative `mu`: seen from below.
FilmImage furnace(Device& device, const Material& material, double mu, double azimuth = 0.0, int64_t spp = 1600) {
    Scene scene = floorOf(material);
    scene.environment = constantEnvironment(1.0f);
    const double r = std::sqrt(1.0 - mu * mu);
    lookAtPoint(scene, glm::dvec3(r * std::cos(azimuth), mu, r * std::sin(azimuth)), glm::vec3(0.0f));
    return renderFilm(device, scene, smallImage(16, spp, 1));
}

/// Midpoint rule over directions of the upper hemisphere (z up): integral of f dz dphi.
double overHemisphere(const std::function<double(glm::dvec3)>& f, int steps) {
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) / steps, r = std::sqrt(1.0 - z * z);
        for (int j = 0; j < 2 * steps; ++j) {
            const double phi = kPi * (j + 0.5) / steps;
            sum += f({r * std::cos(phi), r * std::sin(phi), z});
        }
    }
    return sum * kPi / (double{1.0} * steps * steps);
}

double fresnel(double cosI, double eta) {
    const double sin2 = (1.0 - cosI * cosI) / (eta * eta);
    if (sin2 >= 1.0) return 1.0;
    const double cosT = std::sqrt(1.0 - sin2);
    const double s = (cosI - eta * cosT) / (cosI + eta * cosT), p = (eta * cosI - cosT) / (eta * cosI + cosT);
    return 0.5 * (s * s + p * p);
}

/// GGX with its alphas along x and y (Walter et al. 2007; Heitz, JCGT 3(2), 2014).
struct Ggx {
    double ax, ay;
    double d(glm::dvec3 h) const {
        const double t = h.x * h.x / (ax * ax) + h.y * h.y / (ay * ay) + h.z * h.z;
        return 1.0 / (kPi * ax * ay * t * t);
    }
    double lambda(glm::dvec3 w) const {
        return 0.5 * (std::sqrt(1.0 + (ax * ax * w.x * w.x + ay * ay * w.y * w.y) / (w.z * w.z)) - 1.0);
    }
};

/// Directional albedo of GGX whose facets reflect `f(o.h)`: the integral over wi, times its cosine.
double reflected(const Ggx& g, glm::dvec3 o, const std::function<double(double)>& f) {
    return overHemisphere(
        [&](glm::dvec3 i) {
            const glm::dvec3 h = glm::normalize(o + i);
            return f(glm::dot(o, h)) * g.d(h) / (1.0 + g.lambda(o) + g.lambda(i)) / (4.0 * o.z);
        },
        700);
}

/// The integral over refracted directions of D G1 G1 (1 - F) and what goes with it, by the half vector: Walter et al.,
/// equations 17, 21 and 23; radiance is not yet scaled by the index.
double refracted(const Ggx& g, glm::dvec3 o, double eta) {
    return overHemisphere(
        [&](glm::dvec3 h) {
            const double oh = glm::dot(o, h);
            const double cos2 = 1.0 - (1.0 - oh * oh) / (eta * eta);
            if (oh <= 0.0 || cos2 <= 0.0) return 0.0;
            const glm::dvec3 i = -o / eta + (oh / eta - std::sqrt(cos2)) * h;
            if (i.z >= 0.0) return 0.0;
            return (1.0 - fresnel(oh, eta)) * g.d(h) * oh / o.z / ((1.0 + g.lambda(o)) * (1.0 + g.lambda(i)));
        },
        700);
}

glm::dvec3 inclined(double mu, double azimuth = 0.0) {
    const double r = std::sqrt(1.0 - mu * mu);
    return {r * std::cos(azimuth), r * std::sin(azimuth), mu};
}

double coatFresnel(double cosTheta) { return 0.04 + 0.96 * std::pow(1.0 - cosTheta, 5); }

TEST_F(Lobes, ClearcoatReflectsItsDirectionalAlbedo) {
    for (const double mu : {1.0, 0.3}) {
        Material m = lambert(0.0f);
        m.clearcoat = 0.8f;
        expectExact(furnace(device_, m, mu), 0.8 * coatFresnel(mu), "smooth");
        m.clearcoatRoughness = 0.6f;
        expectExact(furnace(device_, m, mu), 0.8 * reflected({0.36, 0.36}, inclined(mu), coatFresnel), "rough");
    }
}

/// Estevez and Kulla's D, and their fit of the masking at its two ends of roughness.
double sheenF(glm::dvec3 o, glm::dvec3 i, double alpha) {
    const auto lambda = [alpha](double x) {
        const auto fit = [alpha](double y) {
            const double p = (1.0 - alpha) * (1.0 - alpha), q = 1.0 - p;
            return (p * 25.3245 + q * 21.5473) /
                       (1.0 + (p * 3.32435 + q * 3.82987) * std::pow(y, p * 0.16801 + q * 0.19823)) -
                   (p * 1.27393 + q * 1.97760) * y - (p * 4.85967 + q * 4.32054);
        };
        return x < 0.5 ? std::exp(fit(x)) : std::exp(2.0 * fit(0.5) - fit(1.0 - x));
    };
    const double sinH = std::sqrt(1.0 - std::pow(glm::normalize(o + i).z, 2));
    const double d = (2.0 + 1.0 / alpha) * std::pow(sinH, 1.0 / alpha) / (2.0 * kPi);
    return d / (1.0 + lambda(o.z) + lambda(i.z)) / (4.0 * o.z * i.z);
}

TEST_F(Lobes, SheenReflectsItsDirectionalAlbedo) {
    for (const auto& [roughness, mu] : {std::pair{0.5f, 0.8}, std::pair{1.0f, 0.1}}) {
        Material m = lambert(0.0f);
        m.sheenColor = {0.9f, 0.6f, 0.3f};
        m.sheenRoughness = roughness;
        const double alpha = static_cast<double>(roughness) * static_cast<double>(roughness);
        const double exact = overHemisphere([&](glm::dvec3 i) { return i.z * sheenF(inclined(mu), i, alpha); }, 500);
        EXPECT_NEAR(sheenAlbedo(mu, alpha, 40), exact, 0.006 * exact);
        expectExact(furnace(device_, m, mu), exact * glm::dvec3(m.sheenColor), "cosine " + std::to_string(mu));
    }
}

/// Metal of two roughnesses; of equal ones (alpha 1) it is what A14 has of one.
TEST_F(Lobes, AnisotropicMetalReflectsItsDirectionalAlbedo) {
    for (const float roughness : {0.5f, 1.0f})
        for (const double azimuth : {0.0, 0.5 * kPi}) {
            Material m = lambert(1.0f);
            m.metallic = 1.0f;
            m.roughness = roughness;
            m.anisotropy = 0.8f;
            const double ab = std::pow(static_cast<double>(roughness), 2), at = ab + (1.0 - ab) * 0.64;
            const double exact = reflected({at, ab}, inclined(0.4, azimuth), [](double) { return 1.0; });
            expectExact(furnace(device_, m, 0.4, azimuth), exact, "azimuth " + std::to_string(azimuth));
            if (roughness == 1.0f) expectExact(furnace(device_, m, 1.0), 1.0 - std::log(2.0), "A14");
        }
}

/// F0 = .04 x the colour, F90 = 1.
TEST_F(Lobes, SpecularColourTintsTheReflectionAtNormalIncidence) {
    Material m = lambert(0.0f);
    m.specular = 1.0f;
    m.specularColor = {1.0f, 0.5f, 3.0f};
    m.roughness = 0.0f;
    expectExact(furnace(device_, m, 1.0), {0.04, 0.02, 0.12});
}

/// What a sheet does not mirror passes as if it were mirrored: both together are A14's albedo.
TEST_F(Lobes, RoughSheetLosesWhatItsFacetsShadow) {
    Material m = glass();
    m.thin = true;
    m.roughness = std::sqrt(0.5f);
    for (const double mu : {1.0, 0.3})
        expectExact(furnace(device_, m, mu), reflected({0.5, 0.5}, inclined(mu), [](double) { return 1.0; }));
}

/// One boundary with radiance 1 on both sides: R + T / n^2 from outside, R + T n^2 from inside.
TEST_F(Lobes, RoughGlassReflectsAndRefracts) {
    Material m = glass();
    m.roughness = std::sqrt(0.4f);
    for (const double mu : {0.3, -0.9, -0.5}) {
        const double eta = mu > 0.0 ? 1.5 : 1.0 / 1.5;
        const Ggx g{0.4, 0.4};
        const glm::dvec3 o = inclined(std::abs(mu));
        const double r = reflected(g, o, [&](double c) { return fresnel(c, eta); }), t = refracted(g, o, eta);
        EXPECT_LE(r + t, 1.0);
        expectExact(furnace(device_, m, mu), r + t / (eta * eta), "cosine " + std::to_string(mu));
    }
}

/// No lobe nor any sum of them gives back more than came.
TEST_F(Lobes, AreNeverAboveOneUnderAWhiteSky) {
    for (const float roughness : {0.2f, 0.9f})
        for (const double mu : {0.5, 0.05}) {
            Material m = lambert(1.0f);
            m.specular = 1.0f;
            m.roughness = roughness;
            m.clearcoat = 1.0f;
            m.clearcoatRoughness = 1.1f - roughness;
            m.sheenColor = glm::vec3(1.0f);
            m.sheenRoughness = roughness;
            m.anisotropy = 0.7f;
            const Estimate all = estimateOf(furnace(device_, m, mu, 0.7, 128));
            m.clearcoat = 0.0f;
            const Estimate sheen = estimateOf(furnace(device_, m, mu, 0.7, 128));
            m.sheenColor = glm::vec3(0.0f);
            const Estimate base = estimateOf(furnace(device_, m, mu, 0.7, 128));
            std::printf("roughness %.1f, cosine %.2f: all %.4f, without clear coat %.4f, without sheen %.4f\n",
                        static_cast<double>(roughness), mu, all.mean, sheen.mean, base.mean);
            for (const Estimate& e : {all, sheen, base}) EXPECT_LE(e.mean, 1.0 + 4.0 * e.standardError + 2e-3);
        }
}

Environment whiteAbove() {
    return environmentOf(64, 32, [](glm::dvec3 d) { return d.y > 0.0 ? 1.0 : 0.0; });
}

/// A8: a slab 1 thick seen from below, light fading to a quarter, 1/2 and .9 on a way of 2 units; all the reflections
/// between its faces add up: T^2 e / (1 - R^2 e^2).
TEST_F(Lobes, LightFadesInAVolumeByBeersLaw) {
    Scene scene;
    scene.environment = whiteAbove();
    Material m = glass();
    m.attenuationColor = {0.25f, 0.5f, 0.9f};
    m.attenuationDistance = 2.0f;
    addMesh(scene, box(addMaterial(scene, m), {-10.0f, -0.5f, -10.0f}, {10.0f, 0.5f, 10.0f}));
    lookAtPoint(scene, {0.0f, -5.0f, 0.0f}, glm::vec3(0.0f));
    const glm::dvec3 e = glm::sqrt(glm::dvec3(m.attenuationColor));
    expectExact(renderFilm(device_, scene, smallImage(16, 4096, 64)), 0.96 * 0.96 * e / (1.0 - 0.04 * 0.04 * e * e));
}

/// Water in glass: their boxes overlap by a unit, and the one of the higher priority is there. Either way the light of
/// a white half-space meets air to glass, R = .04, and glass to water, R = ((1.5 - 1.33) / (1.5 + 1.33))^2, and then
/// black.
TEST_F(Lobes, NestedVolumesMeetAtOneBoundary) {
    for (const bool glassWins : {true, false}) {
        Scene scene;
        scene.environment = whiteAbove();
        Material outer = glass(1.5f), inner = glass(1.33f);
        (glassWins ? outer : inner).priority = 2;
        (glassWins ? inner : outer).priority = 1;
        addMesh(scene, box(addMaterial(scene, outer), {-10.0f, -2.0f, -10.0f}, {10.0f, 0.0f, 10.0f}));
        addMesh(scene, box(addMaterial(scene, inner), {-9.0f, -3.0f, -9.0f}, {9.0f, -1.0f, 9.0f}));
        addMesh(scene, floorQuad(addMaterial(scene, lambert(0.0f)), 8.0f, -2.5f));
        lookAtPoint(scene, {0.0f, 5.0f, 0.0f}, glm::vec3(0.0f));
        RenderSettings settings = smallImage(16, 16384, 16);
        settings.rouletteDepth = 16;
        const double r = std::pow(0.17 / 2.83, 2);
        expectExact(renderFilm(device_, scene, settings), 0.04 + 0.96 * 0.96 * r / (1.0 - 0.04 * r),
                    glassWins ? "glass wins" : "water wins");
    }
}

}  // namespace
}  // namespace raylab::support
