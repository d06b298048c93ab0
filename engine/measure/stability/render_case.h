#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "engine/measure/stability/battery.h"
#include "engine/render/film.h"
#include "engine/scene/scene.h"

/// Renderings as measurements.
namespace raylab::stability {

/// `settings` for a square image; the seed is fixed.
RenderSettings smallImage(RenderSettings settings, int64_t size, int64_t spp, int64_t depth);

/// Settles the environment and renders all samples. `betweenSteps` may throw.
FilmImage renderFilm(Device& device, Scene scene, const RenderSettings& settings,
                     const std::function<void()>& betweenSteps = {});
/// The same, stopped where the context is.
FilmImage renderFilm(const Context& context, const Scene& scene, const RenderSettings& settings);

/// The mean of pixels that all estimate the same quantity, or parts of the same integral.
struct Estimate {
    double mean = 0.0;
    double standardError = 0.0;
};

/// Over all pixels of one channel; the error from the variance within the pixels. Stratified samples do better than it
/// says, never worse.
Estimate estimateOf(const FilmImage& film, int channel = 0);

/// Pixels of which a channel is further from `exact` than a share of it, or not a number. Marked in red in `picture`
/// above a dim image of the rest, where there is any.
size_t countWrongPixels(const FilmImage& film, double exact, double relativeTolerance, std::optional<Bitmap>& picture);

/// Adds countWrongPixels() to the number; its picture and its evidence are of the first image in which one is wrong.
void judgePixels(Number& number, const Scene& scene, const RenderSettings& settings, const FilmImage& film,
                 double exact, double relativeTolerance);

/// Slope of log y over log x by least squares.
double logSlope(std::span<const glm::dvec2> points);

/// An image of which a number without a limit speaks, or one that fails.
void showImage(Number& number, const Scene& scene, const RenderSettings& settings, const FilmImage& film);

/// Points of a picture of `size` pixels a side, (0,0) to (1,1) from its upper left corner, bright on grey.
Bitmap scatterPicture(std::span<const glm::dvec2> points, int size = 256);

/// Direction on a latitude-longitude map, for scatterPicture().
glm::dvec2 onMap(const glm::dvec3& direction);

/// Shows the rays `wrong` of a number that fails: on a map of their directions, and as evidence.
void showWrongRays(Number& number, const Scene& scene, const RenderSettings& settings,
                   std::span<const shared::RayData> rays, std::span<const size_t> wrong);

/// A number's rays of one kind, counted; wrong ones are shown where there must be none.
Number rayNumber(std::string what, const Scene& scene, const RenderSettings& settings,
                 std::span<const shared::RayData> rays, std::span<const size_t> wrong, size_t of);

/// Four digits.
std::string shortText(double number);

/// Radiance as it is shown, for pictures.
Bitmap displayed(const Bitmap& radiance);

}  // namespace raylab::stability
