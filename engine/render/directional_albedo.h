#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace raylab {

/// What a rough surface reflects of light from one direction, for two reflectances of its microfacets: 1, and Schlick's
/// term (1 - cos)^5. By Schlick's approximation all others are sums of these: f0 (one - grazing) + f90 grazing.
struct GgxAlbedo {
    double one = 1.0;
    double grazing = 0.0;
};

/// Directional albedo of single-scatter GGX (height-correlated Smith masking) at the cosine `mu`, in [0, 1], for
/// `alpha`, in [0, 1]: the expectation of G2 / G1 over visible normals (Heitz, "Sampling the GGX Distribution of
/// Visible Normals", JCGT 7(4), 2018), by the midpoint rule in `steps` x `steps` points. Error within 1e-3 with 40.
GgxAlbedo ggxAlbedo(double mu, double alpha, int steps);

/// Directional albedo of white sheen (Estevez, Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH course,
/// 2017: the distribution of equation 2, masked by the fit of section 3) at the cosine `mu` for `alpha`, the square of
/// its roughness, by the midpoint rule in `steps` x `steps` points. Above 1, up to 2.1, for roughness below .3 and mu
/// below .1.
double sheenAlbedo(double mu, double alpha, int steps);

/// The kernels' tables (shaders/materials/albedo.glsl). GGX: kAlbedoCells rows of cells over the square roots of mu
/// (columns) and of alpha (rows), each with its four corners, so that one load serves; then, a word for each row of
/// cells, the averages over the cosine-weighted hemisphere at its two roughnesses, of what the kernel interpolates.
/// Pairs (one, grazing) of 2 x 16 bits, unsigned normalised. Always the same; takes some 30 ms of one core.
std::vector<glm::uvec4> makeAlbedoTable();

/// As many cells for sheen, over the square root of mu and the roughness, over kMostSheenAlbedo: the four corners in
/// the first two components. Takes some 70 ms of one core.
std::vector<glm::uvec4> makeSheenTable();

}  // namespace raylab
