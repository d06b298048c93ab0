#pragma once

#include <glm/glm.hpp>
#include <string>

#include "engine/measure/stability/render_case.h"

namespace raylab::support {

using stability::Estimate;
using stability::estimateOf;

/// The battery's criterion (design: batteries.md) in each channel: |mean - exact| at most 4 standard errors (6e-5 to
/// fail at random) and at most 0.5 %; rounding may move the mean by 2e-5. Fails also where the standard error is above
/// 0.25 %: a test that cannot tell. Prints a row: the case, the mean and its standard error, the exact value.
void expectExact(const FilmImage& film, glm::dvec3 exact, const std::string& what = "");
void expectExact(const FilmImage& film, double exact, const std::string& what = "");

/// Every pixel and channel, to a relative tolerance: for estimators without variance. The row has the furthest pixel's
/// distance for a standard error.
void expectEveryPixel(const FilmImage& film, glm::dvec3 exact, double relativeTolerance, const std::string& what = "");
void expectEveryPixel(const FilmImage& film, double exact, double relativeTolerance, const std::string& what = "");

/// Values of `a` that are further from those of `b` than a share of them, or not numbers.
size_t countDifferent(const Bitmap& a, const Bitmap& b, float relativeTolerance);

}  // namespace raylab::support
