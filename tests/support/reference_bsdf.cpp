#include "tests/support/reference_bsdf.h"

#include <algorithm>
#include <cmath>

#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

constexpr int kSteps = 96;

double schlick(double f0, double f90, double cosTheta) { return f0 + (f90 - f0) * std::pow(1.0 - cosTheta, 5); }

double distribution(glm::dvec3 h, double ax, double ay) {
    const double t = h.x * h.x / (ax * ax) + h.y * h.y / (ay * ay) + h.z * h.z;
    return 1.0 / (kPi * ax * ay * t * t);
}

double lambda(glm::dvec3 w, double ax, double ay) {
    return 0.5 * (std::sqrt(1.0 + (ax * ax * w.x * w.x + ay * ay * w.y * w.y) / (w.z * w.z)) - 1.0);
}

double sheenLambda(double x, double alpha) {
    const double p = (1.0 - alpha) * (1.0 - alpha), q = 1.0 - p;
    const auto fit = [&](double y) {
        return (p * 25.3245 + q * 21.5473) /
                   (1.0 + (p * 3.32435 + q * 3.82987) * std::pow(y, p * 0.16801 + q * 0.19823)) -
               (p * 1.27393 + q * 1.97760) * y - (p * 4.85967 + q * 4.32054);
    };
    return std::exp(x < 0.5 ? fit(x) : 2.0 * fit(0.5) - fit(1.0 - x));
}

/// Directional albedo of an isotropic f at the cosine mu, by Gauss' rule of two points in each of kSteps cells of the
/// cosine and the midpoint rule over half of the azimuth.
template <class F>
double albedo(double mu, F&& f) {
    mu = std::max(mu, 1e-4);
    const glm::dvec3 o(std::sqrt(1.0 - mu * mu), 0.0, mu);
    const double offset = 0.5 / std::sqrt(3.0);
    double sum = 0.0;
    for (int k = 0; k < 2 * kSteps; ++k) {
        const double z = (k / 2 + 0.5 + (k % 2 == 0 ? -offset : offset)) / kSteps, r = std::sqrt(1.0 - z * z);
        for (int j = 0; j < kSteps; ++j) {
            const double phi = kPi * (j + 0.5) / kSteps;
            sum += z * f(o, glm::dvec3(r * std::cos(phi), r * std::sin(phi), z));
        }
    }
    return sum * kPi / (double{kSteps} * kSteps);
}

}  // namespace

double referenceFresnel(double cosI, double eta) {
    const double sin2 = (1.0 - cosI * cosI) / (eta * eta);
    if (sin2 >= 1.0) return 1.0;
    const double cosT = std::sqrt(1.0 - sin2);
    const double s = (cosI - eta * cosT) / (cosI + eta * cosT), p = (eta * cosI - cosT) / (eta * cosI + cosT);
    return 0.5 * (s * s + p * p);
}

ReferenceBsdf::ReferenceBsdf(const Material& material) : material_(&material) {
    const auto square = [](float x) { return static_cast<double>(x) * static_cast<double>(x); };
    metallic_ = static_cast<double>(material.metallic);
    alpha_ = square(material.roughness);
    alphaAlong_ = alpha_ + (1.0 - alpha_) * square(material.anisotropy);
    coatAlpha_ = square(material.clearcoatRoughness);
    sheenAlpha_ = square(material.sheenRoughness);
    const double ior = static_cast<double>(material.ior), specular = static_cast<double>(material.specular);
    const double r = (ior - 1.0) * (ior - 1.0) / ((ior + 1.0) * (ior + 1.0));
    f90_ = specular;
    f0Rgb_ = specular * glm::min(r * glm::dvec3(material.specularColor), glm::dvec3(1.0));
    f0_ = std::max({f0Rgb_.x, f0Rgb_.y, f0Rgb_.z});
    for (int k = 0; k <= kMus; ++k) {
        const double mu = static_cast<double>(k) / kMus;
        // Below the coat of an anisotropic surface counts the smaller of the two roughnesses.
        if (metallic_ < 1.0 && specular > 0.0)
            baseAlbedo_[k] = albedo(mu, [&](glm::dvec3 o, glm::dvec3 i) {
                return facets(o, i, alpha_, alpha_) * schlick(f0_, f90_, glm::dot(o, glm::normalize(o + i)));
            });
        if (material.clearcoat > 0.0f)
            coatAlbedo_[k] = static_cast<double>(material.clearcoat) * albedo(mu, [&](glm::dvec3 o, glm::dvec3 i) {
                                 return facets(o, i, coatAlpha_, coatAlpha_) *
                                        schlick(0.04, 1.0, glm::dot(o, glm::normalize(o + i)));
                             });
        if (material.sheenColor != glm::vec3(0.0f))
            sheenAlbedo_[k] = albedo(mu, [&](glm::dvec3 o, glm::dvec3 i) { return sheen(o, i); });
    }
    for (int k = 0; k < 8 * kMus; ++k) {
        const double mu = (k + 0.5) / (8 * kMus);
        baseAverage_ += 2.0 * mu * at(baseAlbedo_, mu) / (8 * kMus);
    }
}

double ReferenceBsdf::at(const Table& table, double mu) {
    const double x = std::clamp(mu, 0.0, 1.0) * kMus;
    const int k = std::min(static_cast<int>(x), kMus - 1);
    return table[k] + (x - k) * (table[k + 1] - table[k]);
}

double ReferenceBsdf::facets(glm::dvec3 o, glm::dvec3 i, double ax, double ay) const {
    const glm::dvec3 h = glm::normalize(o + i);
    return distribution(h, ax, ay) / (1.0 + lambda(o, ax, ay) + lambda(i, ax, ay)) / (4.0 * o.z * i.z);
}

double ReferenceBsdf::sheen(glm::dvec3 o, glm::dvec3 i) const {
    const double z = glm::normalize(o + i).z;
    const double d = (2.0 + 1.0 / sheenAlpha_) * std::pow(1.0 - z * z, 0.5 / sheenAlpha_) / (2.0 * kPi);
    return d / (1.0 + sheenLambda(o.z, sheenAlpha_) + sheenLambda(i.z, sheenAlpha_)) / (4.0 * o.z * i.z);
}

glm::dvec3 ReferenceBsdf::base(glm::dvec3 o, glm::dvec3 i) const {
    const glm::dvec3 color(material_->baseColor);
    const glm::dvec3 diffuse = color * (1.0 - metallic_) / kPi * (1.0 - at(baseAlbedo_, o.z)) *
                               (1.0 - at(baseAlbedo_, i.z)) / (1.0 - baseAverage_);
    const double m5 = std::pow(1.0 - glm::dot(o, glm::normalize(o + i)), 5);
    const glm::dvec3 dielectric = f0Rgb_ + (f90_ - f0Rgb_) * m5, metal = color + (1.0 - color) * m5;
    const glm::dvec3 fresnel = glm::mix(dielectric, metal, metallic_);
    return fresnel == glm::dvec3(0.0) ? diffuse : diffuse + fresnel * facets(o, i, alphaAlong_, alpha_);
}

glm::dvec3 ReferenceBsdf::opaque(glm::dvec3 o, glm::dvec3 i) const {
    glm::dvec3 value = base(o, i);
    const glm::dvec3 sheenColor(material_->sheenColor);
    if (const double most = std::max({sheenColor.x, sheenColor.y, sheenColor.z}); most > 0.0)
        value =
            value * (1.0 - most * std::max(at(sheenAlbedo_, o.z), at(sheenAlbedo_, i.z))) + sheenColor * sheen(o, i);
    if (const auto coat = static_cast<double>(material_->clearcoat); coat > 0.0) {
        const double fresnel = schlick(0.04, 1.0, glm::dot(o, glm::normalize(o + i)));
        value = value * (1.0 - std::max(at(coatAlbedo_, o.z), at(coatAlbedo_, i.z))) +
                coat * fresnel * facets(o, i, coatAlpha_, coatAlpha_);
    }
    return value;
}

glm::dvec3 ReferenceBsdf::roughGlass(glm::dvec3 o, glm::dvec3 i, double eta) const {
    if (i.z > 0.0) {
        const double fresnel = referenceFresnel(glm::dot(o, glm::normalize(o + i)), eta);
        return glm::dvec3(fresnel * facets(o, i, alpha_, alpha_));
    }
    // Walter et al. 2007, equations 16 and 21; their index of o's side is 1.
    glm::dvec3 h = -glm::normalize(o + eta * i);
    if (h.z < 0.0) h = -h;
    const double oh = glm::dot(o, h), ih = glm::dot(i, h);
    if (oh <= 0.0 || ih >= 0.0) return glm::dvec3(0.0);
    const double g = 1.0 / ((1.0 + lambda(o, alpha_, alpha_)) * (1.0 + lambda(i, alpha_, alpha_)));
    const double f = std::abs(oh * ih / (o.z * i.z)) * (1.0 - referenceFresnel(oh, eta)) * g *
                     distribution(h, alpha_, alpha_) / std::pow(oh + eta * ih, 2);
    return glm::dvec3(material_->baseColor) * f;
}

}  // namespace raylab::support
