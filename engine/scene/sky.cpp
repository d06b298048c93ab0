#include "engine/scene/sky.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace raylab {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kUnitKcd = 14.0;  // kcd/m^2 of one unit of radiance
constexpr double kSunRadius = 0.2666 * kPi / 180.0;
constexpr double kSolarIlluminanceKlux = 133.0;  // outside the atmosphere
constexpr double kGroundAlbedo = 0.25;
constexpr double kLowestSunCosine = 0.02;

glm::dvec3 xyyToRgb(double x, double y, double luminance) {
    const double X = x / y * luminance, Z = (1.0 - x - y) / y * luminance;
    return {3.2404542 * X - 1.5371385 * luminance - 0.4985314 * Z,
            -0.9692660 * X + 1.8760108 * luminance + 0.0415560 * Z,
            0.0556434 * X - 0.2040259 * luminance + 1.0572252 * Z};
}

/// The five coefficients of a Perez distribution.
using Perez = std::array<double, 5>;

double perez(const Perez& c, double cosTheta, double gamma) {
    const double cosGamma = std::cos(gamma);
    return (1.0 + c[0] * std::exp(c[1] / cosTheta)) *
           (1.0 + c[2] * std::exp(c[3] * gamma) + c[4] * cosGamma * cosGamma);
}

struct Daylight {
    Perez luminance, x, y;
    double zenithLuminance, zenithX, zenithY;  // each divided by its Perez value at the zenith
};

Daylight daylight(double t, double thetaSun) {
    Daylight d{};
    d.luminance = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                   -0.0670 * t + 0.3703};
    d.x = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
           -0.0033 * t + 0.0452};
    d.y = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
           -0.0109 * t + 0.0529};
    const double s = thetaSun, s2 = s * s, s3 = s2 * s;
    const double chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * s);
    const double zenithLuminance = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
    const double zenithX = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
                           t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                           (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886);
    const double zenithY = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
                           t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
                           (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688);
    d.zenithLuminance = std::max(zenithLuminance, 0.0) / perez(d.luminance, 1.0, s);
    d.zenithX = zenithX / perez(d.x, 1.0, s);
    d.zenithY = zenithY / perez(d.y, 1.0, s);
    return d;
}

glm::dvec3 skyRadiance(const Daylight& d, double cosTheta, double gamma) {
    const double c = std::max(cosTheta, 0.01);
    const double luminance = d.zenithLuminance * perez(d.luminance, c, gamma);
    const glm::dvec3 rgb = xyyToRgb(d.zenithX * perez(d.x, c, gamma), d.zenithY * perez(d.y, c, gamma), luminance);
    return glm::max(rgb, glm::dvec3(0.0)) / kUnitKcd;
}

/// Irradiance of the sun on a plane that faces it.
glm::dvec3 sunIrradiance(double turbidity, double cosSun) {
    const double thetaDegrees = std::acos(cosSun) * 180.0 / kPi;
    const double mass = 1.0 / (cosSun + 0.15 * std::pow(93.885 - thetaDegrees, -1.253));
    const double beta = 0.04608 * turbidity - 0.04586;
    glm::dvec3 transmitted;
    for (int channel = 0; channel < 3; ++channel) {
        const double micrometres = std::array{0.63, 0.545, 0.455}[static_cast<size_t>(channel)];
        const double rayleigh = 0.008735 * std::pow(micrometres, -4.08);
        const double aerosol = std::max(beta, 0.0) * std::pow(micrometres, -1.3);
        transmitted[channel] = std::exp(-(rayleigh + aerosol) * mass);
    }
    return transmitted * (kSolarIlluminanceKlux / kUnitKcd);
}

glm::dvec3 texelDirection(double column, double row, int width, int height) {
    const double phi = (column / width - 0.5) * 2.0 * kPi, theta = row / height * kPi;
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

double texelSolidAngle(int row, int width, int height) {
    return 2.0 * kPi / width * (std::cos(kPi * row / height) - std::cos(kPi * (row + 1) / height));
}

/// Share of a texel that the sun's disc covers.
double sunCoverage(int column, int row, int width, int height, const glm::dvec3& sun) {
    constexpr int kSteps = 16;
    if (glm::dot(texelDirection(column + 0.5, row + 0.5, width, height), sun) <
        std::cos(kSunRadius + 4.0 * kPi / height))
        return 0.0;
    int inside = 0;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const double x = column + (i % kSteps + 0.5) / kSteps, y = row + (i / kSteps + 0.5) / kSteps;
        if (glm::dot(texelDirection(x, y, width, height), sun) >= std::cos(kSunRadius)) ++inside;
    }
    return static_cast<double>(inside) / (kSteps * kSteps);
}

void store(Bitmap& map, int column, int row, const glm::dvec3& radiance) {
    for (int channel = 0; channel < 3; ++channel) map.at(column, row)[channel] += static_cast<float>(radiance[channel]);
}

void addSky(Bitmap& map, const Daylight& d, const glm::dvec3& sun, double scale) {
    tbb::parallel_for(0, map.height / 2, [&](int row) {
        for (int column = 0; column < map.width; ++column) {
            const glm::dvec3 direction = texelDirection(column + 0.5, row + 0.5, map.width, map.height);
            const double gamma = std::acos(std::clamp(glm::dot(direction, sun), -1.0, 1.0));
            store(map, column, row, scale * skyRadiance(d, direction.y, gamma));
        }
    });
}

void addSun(Bitmap& map, const glm::dvec3& irradiance, const glm::dvec3& sun) {
    std::vector<std::pair<glm::ivec2, double>> covered;
    double solidAngle = 0.0;
    for (int row = 0; row < map.height / 2; ++row)
        for (int column = 0; column < map.width; ++column)
            if (const double share = sunCoverage(column, row, map.width, map.height, sun); share > 0.0) {
                covered.push_back({{column, row}, share});
                solidAngle += share * texelSolidAngle(row, map.width, map.height);
            }
    for (const auto& [texel, share] : covered) store(map, texel.x, texel.y, irradiance * (share / solidAngle));
}

/// Integral of the first `rows` of the map over solid angle, each row weighed by `weight` of its middle's cosine.
template <class Weight>
glm::dvec3 integrate(const Bitmap& map, int rows, Weight&& weight) {
    glm::dvec3 sum(0.0);
    for (int row = 0; row < rows; ++row) {
        const double share = texelSolidAngle(row, map.width, map.height) * weight(std::cos(kPi * (row + 0.5) / map.height));
        for (int column = 0; column < map.width; ++column) {
            const float* p = map.at(column, row);
            sum += share * glm::dvec3(p[0], p[1], p[2]);
        }
    }
    return sum;
}

glm::dvec3 irradianceOnGround(const Bitmap& map) {
    return integrate(map, map.height / 2, [](double cosine) { return cosine; });
}

glm::dvec3 meanRadiance(const Bitmap& map) {
    return integrate(map, map.height, [](double) { return 1.0; }) / (4.0 * kPi);
}

}  // namespace

glm::vec3 skyDirection(float elevationRadians, float azimuthRadians) {
    return {std::cos(elevationRadians) * std::sin(azimuthRadians), std::sin(elevationRadians),
            -std::cos(elevationRadians) * std::cos(azimuthRadians)};
}

Environment makeSky(const SkyDescription& sky, int width) {
    Environment environment{Bitmap(width, width / 2, 3)};
    Bitmap& map = environment.radiance;
    const glm::dvec3 sun(skyDirection(sky.sunElevationRadians, sky.sunAzimuthRadians));
    const double cosSun = std::max(sun.y, kLowestSunCosine);
    addSky(map, daylight(sky.turbidity, std::acos(cosSun)), sun, sky.scale);
    const glm::dvec3 irradiance = static_cast<double>(sky.scale) * sunIrradiance(sky.turbidity, cosSun);
    addSun(map, irradiance, sun);
    const glm::dvec3 ground = irradianceOnGround(map) * (kGroundAlbedo / kPi);
    for (int row = map.height / 2; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) store(map, column, row, ground);
    // The sun's disc gives all of its irradiance: its mean over the sphere is that over 4 pi.
    environment.parts = SunAndSky{sun, irradiance, meanRadiance(map) - irradiance / (4.0 * kPi)};
    return environment;
}

}  // namespace raylab
