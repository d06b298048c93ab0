#include "ui/editor/picture.h"

#include <algorithm>

#include "engine/image/image8.h"
#include "engine/render/integrators.h"
#include "engine/render/tonemap.h"

namespace raylab {
namespace {

/// Pixels without a sample show the nearest of the backdrop.
void fillGaps(Bitmap& mean, const Bitmap& samples, const Bitmap& backdrop) {
    if (backdrop.pixelCount() == 0) return;
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x) {
            if (*samples.at(x, y) > 0.0f) continue;
            const float* from = backdrop.at(x * backdrop.width / mean.width, y * backdrop.height / mean.height);
            std::copy_n(from, 3, mean.at(x, y));
        }
}

}  // namespace

Bitmap displayImage(Bitmap mean, const RenderSettings& settings, float sceneDiagonal) {
    const IntegratorInfo& info = findIntegrator(settings.integrator);
    if (!info.isView) return tonemapImage(mean, settings.exposure, settings.tonemap);
    if (info.name == "depth" && sceneDiagonal > 0.0f)
        for (float& value : mean.pixels) value /= sceneDiagonal;
    return mean;
}

Picture developPicture(const FilmImage& film, const Bitmap& backdrop, const RenderSettings& settings,
                       float sceneDiagonal) {
    Bitmap mean = film.mean;
    fillGaps(mean, film.samples, backdrop);
    Image8 display = encodeSrgb8(displayImage(std::move(mean), settings, sceneDiagonal));
    Picture picture;
    picture.width = display.width;
    picture.height = display.height;
    picture.texels = std::move(display.texels);
    return picture;
}

}  // namespace raylab
