#include "engine/render/directional_albedo.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "shaders/shared/scene.h"

namespace raylab {
namespace {

constexpr int kCells = static_cast<int>(shared::kAlbedoCells);
constexpr int kTableSteps = 40;
constexpr double kSmallestSheenAlpha = static_cast<double>(shared::kSmallestSheenAlpha);

/// Albedos at the corners of a row of cells.
using Row = std::array<GgxAlbedo, kCells + 1>;

uint32_t packed(GgxAlbedo albedo) { return glm::packUnorm2x16(glm::vec2(albedo.one, albedo.grazing)); }

/// 2 x integral of E mu dmu = 4 x integral of E x^3 dx, E linear in x = sqrt(mu) within each cell.
GgxAlbedo averageOf(const Row& row) {
    GgxAlbedo sum{0.0, 0.0};
    for (int i = 0; i < kCells; ++i) {
        const double lo = static_cast<double>(i) / kCells, hi = static_cast<double>(i + 1) / kCells;
        const double whole = std::pow(hi, 4) - std::pow(lo, 4);
        const double upper = (0.8 * (std::pow(hi, 5) - std::pow(lo, 5)) - lo * whole) * kCells;
        sum.one += (whole - upper) * row[i].one + upper * row[i + 1].one;
        sum.grazing += (whole - upper) * row[i].grazing + upper * row[i + 1].grazing;
    }
    return sum;
}

double ggxLambda(double mu, double alpha) {
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 / (mu * mu) - 1.0)) - 1.0);
}

/// Masking of sheen: exp of the fitted function, mirrored about cos = .5.
double sheenLambda(double mu, double alpha) {
    constexpr std::array kRough = {21.5473, 3.82987, 0.19823, -1.97760, -4.32054};
    constexpr std::array kSharp = {25.3245, 3.32435, 0.16801, -1.27393, -4.85967};
    const double sharpness = (1.0 - alpha) * (1.0 - alpha);
    const auto fit = [&](double x) {
        std::array<double, 5> p{};
        for (size_t i = 0; i < p.size(); ++i) p[i] = sharpness * kSharp[i] + (1.0 - sharpness) * kRough[i];
        return p[0] / (1.0 + p[1] * std::pow(x, p[2])) + p[3] * x + p[4];
    };
    return std::exp(mu < 0.5 ? fit(mu) : 2.0 * fit(0.5) - fit(1.0 - mu));
}

}  // namespace

GgxAlbedo ggxAlbedo(double mu, double alpha, int steps) {
    mu = std::clamp(mu, 1e-5, 1.0);
    alpha = std::max(alpha, 1e-6);
    const glm::dvec3 o(std::sqrt(1.0 - mu * mu), 0.0, mu);
    const glm::dvec3 w = glm::normalize(glm::dvec3(alpha * o.x, 0.0, mu));
    const double lambdaO = ggxLambda(mu, alpha);
    GgxAlbedo sum{0.0, 0.0};
    for (int i = 0; i < steps; ++i) {
        // Visible normals are half-way vectors of w and of uniform directions on the cap above -w.z (Dupuy, Benyoub
        // 2023). Closer together at both ends, of which one is where light is reflected below the horizon.
        const double t = (i + 0.5) / steps, share = 6.0 * t * (1.0 - t);
        const double z = 1.0 - t * t * (3.0 - 2.0 * t) * (1.0 + w.z), r = std::sqrt(std::max(0.0, 1.0 - z * z));
        for (int j = 0; j < steps; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / steps;  // the other half is the mirror image
            const glm::dvec3 c = glm::dvec3(r * std::cos(phi), r * std::sin(phi), z) + w;
            const glm::dvec3 h = glm::normalize(glm::dvec3(alpha * c.x, alpha * c.y, c.z));
            const double oh = glm::dot(o, h), cosI = 2.0 * oh * h.z - mu;
            if (oh <= 0.0 || cosI <= 0.0) continue;
            const double weight = share * (1.0 + lambdaO) / (1.0 + lambdaO + ggxLambda(cosI, alpha));
            sum.one += weight;
            sum.grazing += weight * std::pow(1.0 - std::min(oh, 1.0), 5);
        }
    }
    const double points = static_cast<double>(steps) * steps;
    return {sum.one / points, sum.grazing / points};
}

double sheenAlbedo(double mu, double alpha, int steps) {
    mu = std::clamp(mu, 1e-4, 1.0);
    alpha = std::max(alpha, kSmallestSheenAlpha);
    const glm::dvec3 o(std::sqrt(1.0 - mu * mu), 0.0, mu);
    const double lambdaO = sheenLambda(mu, alpha);
    const double power = 0.5 / alpha;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double cosI = (i + 0.5) / steps, sinI = std::sqrt(1.0 - cosI * cosI);
        const double masked = 1.0 / (1.0 + lambdaO + sheenLambda(cosI, alpha));
        for (int j = 0; j < steps; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / steps;
            const glm::dvec3 h = glm::normalize(o + glm::dvec3(sinI * std::cos(phi), sinI * std::sin(phi), cosI));
            sum += std::pow(std::max(0.0, 1.0 - h.z * h.z), power) * masked;
        }
    }
    // D = (2 + 1/alpha) sin^(1/alpha) / (2 pi); over 2 pi of azimuth and the four cosines of Torrance and Sparrow.
    return (2.0 + 1.0 / alpha) * sum / (4.0 * mu * steps * steps);
}

std::vector<glm::uvec4> makeAlbedoTable() {
    std::array<Row, kCells + 1> rows;
    tbb::parallel_for(0, kCells + 1, [&](int y) {
        const double root = static_cast<double>(y) / kCells;
        for (int x = 0; x <= kCells; ++x) {
            const double mu = std::pow(static_cast<double>(x) / kCells, 2);
            // Without roughness: a mirror.
            rows[y][x] = y == 0 ? GgxAlbedo{1.0, std::pow(1.0 - mu, 5)} : ggxAlbedo(mu, root * root, kTableSteps);
        }
    });
    std::vector<glm::uvec4> words;
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x)
            words.emplace_back(packed(rows[y][x]), packed(rows[y][x + 1]), packed(rows[y + 1][x]),
                               packed(rows[y + 1][x + 1]));
    for (int y = 0; y < kCells; ++y)
        words.emplace_back(packed(averageOf(rows[y])), packed(averageOf(rows[y + 1])), 0u, 0u);
    return words;
}

std::vector<glm::uvec4> makeSheenTable() {
    std::array<std::array<float, kCells + 1>, kCells + 1> table;
    tbb::parallel_for(0, kCells + 1, [&](int y) {
        const double roughness = static_cast<double>(y) / kCells;
        for (int x = 0; x <= kCells; ++x) {
            const double albedo =
                sheenAlbedo(std::pow(static_cast<double>(x) / kCells, 2), roughness * roughness, kTableSteps);
            table[y][x] = static_cast<float>(albedo) / shared::kMostSheenAlbedo;
        }
    });
    std::vector<glm::uvec4> words;
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x)
            words.emplace_back(glm::packUnorm2x16({table[y][x], table[y][x + 1]}),
                               glm::packUnorm2x16({table[y + 1][x], table[y + 1][x + 1]}), 0u, 0u);
    return words;
}

}  // namespace raylab
