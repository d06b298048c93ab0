#pragma once

#include <array>
#include <glm/glm.hpp>

#include "engine/scene/scene.h"

namespace raylab::support {

/// Unpolarised reflectance of a boundary, `eta` the far index over the near one.
double referenceFresnel(double cosI, double eta);

/// A material's scattering in double precision, in a frame with z along the normal on o's side and x along the
/// direction of the larger roughness. docs/methods.md says what it is; every directional albedo is integrated, not
/// looked up.
class ReferenceBsdf {
public:
    explicit ReferenceBsdf(const Material& material);

    const Material& material() const { return *material_; }
    double through() const { return static_cast<double>(material_->transmission) * (1.0 - metallic_); }
    /// f of the opaque lobes, both directions above.
    glm::dvec3 opaque(glm::dvec3 o, glm::dvec3 i) const;
    /// f of rough glass of relative index `eta`, i on either side.
    glm::dvec3 roughGlass(glm::dvec3 o, glm::dvec3 i, double eta) const;
    bool isSmoothGlass() const { return material_->roughness == 0.0f; }

private:
    static constexpr int kMus = 64;
    using Table = std::array<double, kMus + 1>;  ///< over mu

    static double at(const Table& table, double mu);
    double facets(glm::dvec3 o, glm::dvec3 i, double alphaX, double alphaY) const;
    glm::dvec3 base(glm::dvec3 o, glm::dvec3 i) const;
    double sheen(glm::dvec3 o, glm::dvec3 i) const;

    const Material* material_;
    double metallic_, alpha_, alphaAlong_, coatAlpha_, sheenAlpha_;
    double f0_, f90_;  ///< of the dielectric
    glm::dvec3 f0Rgb_;
    Table baseAlbedo_{}, coatAlbedo_{}, sheenAlbedo_{};
    double baseAverage_ = 0.0;
};

}  // namespace raylab::support
