#include "engine/measure/cost_fit.h"

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "engine/core/error.h"

namespace raylab {
namespace {

constexpr size_t kUnknowns = 3;
/// Of the normal matrix with a diagonal of 1: below, two of its columns agree to some five digits.
constexpr double kSmallestDeterminant = 1e-10;

/// A sample's row of the equations, divided by its time: its right side is 1.
glm::dvec3 rowOf(const CostSample& sample) { return glm::dvec3(1.0, sample.nodes, sample.triangles) / sample.nsPerRay; }

/// Columns are scaled to length 1 before the inversion, so that its determinant says how well they are told apart.
glm::dmat3 inverseOfNormal(const glm::dmat3& normal) {
    glm::dvec3 scale;
    for (int i = 0; i < 3; ++i) scale[i] = normal[i][i] > 0.0 ? 1.0 / std::sqrt(normal[i][i]) : 0.0;
    glm::dmat3 unit;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) unit[i][j] = normal[i][j] * scale[i] * scale[j];
    if (!(glm::determinant(unit) > kSmallestDeterminant))
        throw Error("these rays do not tell what a node costs and what a triangle; name more scenes or kinds of rays");
    glm::dmat3 inverse = glm::inverse(unit);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) inverse[i][j] *= scale[i] * scale[j];
    return inverse;
}

Estimate ratioOf(const CostFit& fit, const glm::dmat3& covariance) {
    const double node = fit.node.value, triangle = fit.triangle.value;
    if (!(node > 0.0)) return {triangle, std::numeric_limits<double>::infinity()};
    const double ratio = triangle / node;
    const double variance =
        (covariance[2][2] - 2.0 * ratio * covariance[1][2] + ratio * ratio * covariance[1][1]) / (node * node);
    return {ratio, std::sqrt(variance)};
}

}  // namespace

CostFit fitCosts(std::span<const CostSample> samples) {
    if (samples.size() <= kUnknowns)
        throw Error("three costs take four measurements at least, and here are " + std::to_string(samples.size()) +
                    "; name more scenes or kinds of rays");
    glm::dmat3 normal(0.0);
    glm::dvec3 right(0.0);
    for (const CostSample& sample : samples) {
        const glm::dvec3 row = rowOf(sample);
        normal += glm::outerProduct(row, row);
        right += row;
    }
    const glm::dmat3 inverse = inverseOfNormal(normal);
    const glm::dvec3 costs = inverse * right;
    double squares = 0.0;
    for (const CostSample& sample : samples) {
        const double residual = 1.0 - glm::dot(rowOf(sample), costs);
        squares += residual * residual;
    }
    const glm::dmat3 covariance = inverse * (squares / static_cast<double>(samples.size() - kUnknowns));
    CostFit fit{.constant = {costs[0], std::sqrt(covariance[0][0])},
                .node = {costs[1], std::sqrt(covariance[1][1])},
                .triangle = {costs[2], std::sqrt(covariance[2][2])},
                .ratio = {},
                .relativeResidual = std::sqrt(squares / static_cast<double>(samples.size())),
                .samples = samples.size()};
    fit.ratio = ratioOf(fit, covariance);
    return fit;
}

}  // namespace raylab
