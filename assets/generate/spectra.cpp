#include "assets/generate/spectra.h"

#include <cmath>

namespace raylab::assets {
namespace {

constexpr int kFirstNm = 400;
constexpr int kLastNm = 700;

/// A Gaussian with one width below its mean and another above.
double lobe(double nm, double mean, double widthBelow, double widthAbove) {
    const double t = (nm - mean) / (nm < mean ? widthBelow : widthAbove);
    return std::exp(-0.5 * t * t);
}

glm::dvec3 colourMatching(double nm) {
    return {
        1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) - 0.065 * lobe(nm, 501.1, 20.4, 26.2),
        0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
        1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

/// IEC 61966-2-1 primaries and white point.
glm::dvec3 xyzToLinearSrgb(const glm::dvec3& xyz) {
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

double integralOfY() {
    double sum = 0.0;
    for (int nm = 360; nm <= 830; ++nm) sum += colourMatching(nm).y;
    return sum;
}

/// Trapezoidal rule at 1 nm.
template <typename Value>
glm::dvec3 integrate(Value&& value) {
    glm::dvec3 xyz(0.0);
    for (int nm = kFirstNm; nm <= kLastNm; ++nm) {
        const double weight = nm == kFirstNm || nm == kLastNm ? 0.5 : 1.0;
        xyz += weight * value(static_cast<float>(nm)) * colourMatching(nm);
    }
    return xyzToLinearSrgb(xyz / integralOfY());
}

}  // namespace

float valueAt(const Spectrum& spectrum, float wavelengthNm) {
    const float last = static_cast<float>(spectrum.values.size() - 1);
    const float position = glm::clamp((wavelengthNm - spectrum.firstNm) / spectrum.stepNm, 0.0f, last);
    const auto below = static_cast<size_t>(position);
    const size_t above = glm::min(below + 1, spectrum.values.size() - 1);
    return glm::mix(spectrum.values[below], spectrum.values[above], position - static_cast<float>(below));
}

glm::vec3 radianceToRgb(const Spectrum& radiance) {
    return integrate([&](float nm) { return static_cast<double>(valueAt(radiance, nm)); });
}

glm::vec3 reflectanceToRgb(const Spectrum& reflectance, const Spectrum& light) {
    const glm::dvec3 reflected =
        integrate([&](float nm) { return static_cast<double>(valueAt(reflectance, nm) * valueAt(light, nm)); });
    const glm::dvec3 incident = integrate([&](float nm) { return static_cast<double>(valueAt(light, nm)); });
    return glm::clamp(glm::vec3(reflected / incident), 0.0f, 1.0f);
}

}  // namespace raylab::assets
