#include "ui/editor/model/color_temperature.h"

#include <algorithm>
#include <cmath>

#include "engine/core/luminance.h"

namespace raylab::editor {
namespace {

constexpr double kSecondRadiationConstant = 1.438776877e-2;  ///< h c / k in m K (CODATA 2018)
constexpr double kLowestNanometres = 360.0;
constexpr double kHighestNanometres = 830.0;
constexpr double kStepNanometres = 2.0;

double lobe(double x, double height, double mean, double below, double above) {
    const double t = (x - mean) * (x < mean ? below : above);
    return height * std::exp(-0.5 * t * t);
}

/// Planck's law to a constant factor.
double spectralRadiance(double nanometres, double kelvin) {
    const double metres = nanometres * 1e-9;
    return 1.0 / (std::pow(nanometres * 1e-3, 5.0) * std::expm1(kSecondRadiationConstant / (metres * kelvin)));
}

glm::dvec3 blackbodyXyz(double kelvin) {
    glm::dvec3 sum(0.0);
    for (double nm = kLowestNanometres; nm <= kHighestNanometres; nm += kStepNanometres)
        sum += colorMatching(nm) * spectralRadiance(nm, kelvin);
    return sum;
}

/// IEC 61966-2-1.
glm::dvec3 linearSrgb(const glm::dvec3& xyz) {
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

}  // namespace

glm::dvec3 colorMatching(double nm) {
    return {lobe(nm, 0.362, 442.0, 0.0624, 0.0374) + lobe(nm, 1.056, 599.8, 0.0264, 0.0323) +
                lobe(nm, -0.065, 501.1, 0.0490, 0.0382),
            lobe(nm, 0.821, 568.8, 0.0213, 0.0247) + lobe(nm, 0.286, 530.9, 0.0613, 0.0322),
            lobe(nm, 1.217, 437.0, 0.0845, 0.0278) + lobe(nm, 0.681, 459.0, 0.0385, 0.0725)};
}

glm::dvec2 blackbodyChromaticity(double kelvin) {
    const glm::dvec3 xyz = blackbodyXyz(kelvin);
    return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

glm::vec3 blackbodyColor(double kelvin) {
    const glm::dvec3 xyz = blackbodyXyz(std::clamp(kelvin, kLowestKelvin, kHighestKelvin));
    const glm::vec3 color(glm::max(linearSrgb(xyz / xyz.y), glm::dvec3(0.0)));
    return color / static_cast<float>(luminance(color));
}

}  // namespace raylab::editor
