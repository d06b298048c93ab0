#include "ui/editor/picture.h"

#include <algorithm>
#include <cmath>

#include "engine/image/image8.h"
#include "engine/render/integrators.h"
#include "engine/render/tonemap.h"

namespace raylab {
namespace {

/// Two neighbours among `count` pixels, and how much the second counts, at a place that is `part` of the whole way.
struct Between {
    Between(float part, int count) {
        const float at = std::clamp(part * static_cast<float>(count) - 0.5f, 0.0f, static_cast<float>(count - 1));
        first = static_cast<int>(at);
        second = std::min(first + 1, count - 1);
        weight = at - static_cast<float>(first);
    }
    int first, second;
    float weight;
};

/// Pixels without a sample show the backdrop, bilinearly.
void fillGaps(Bitmap& mean, const Bitmap& samples, const Bitmap& backdrop) {
    if (backdrop.pixelCount() == 0) return;
    const auto part = [](int i, int count) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(count); };
    for (int y = 0; y < mean.height; ++y) {
        const Between v(part(y, mean.height), backdrop.height);
        for (int x = 0; x < mean.width; ++x) {
            if (*samples.at(x, y) > 0.0f) continue;
            const Between u(part(x, mean.width), backdrop.width);
            for (int c = 0; c < 3; ++c) {
                const float top = std::lerp(backdrop.at(u.first, v.first)[c], backdrop.at(u.second, v.first)[c], u.weight);
                const float low = std::lerp(backdrop.at(u.first, v.second)[c], backdrop.at(u.second, v.second)[c], u.weight);
                mean.at(x, y)[c] = std::lerp(top, low, v.weight);
            }
        }
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
    Bitmap mean = film.picture();
    fillGaps(mean, film.samples, backdrop);
    Image8 display = encodeSrgb8(displayImage(std::move(mean), settings, sceneDiagonal));
    Picture picture;
    picture.width = display.width;
    picture.height = display.height;
    picture.texels = std::move(display.texels);
    return picture;
}

}  // namespace raylab
