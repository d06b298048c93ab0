#include "engine/render/tonemap.h"

#include <array>
#include <cmath>

#include "engine/core/error.h"
#include "shaders/shared/tonemap.h"

namespace raylab {
namespace {

struct Curve {
    const char* name;
    uint32_t id;
};

constexpr std::array kCurves = {Curve{"filmic", shared::kTonemapFilmic}, Curve{"reinhard", shared::kTonemapReinhard},
                                Curve{"linear", shared::kTonemapLinear}};

uint32_t curveId(const std::string& name) {
    for (const Curve& curve : kCurves)
        if (name == curve.name) return curve.id;
    throw Error("there is no tonemap '" + name + "'");
}

}  // namespace

std::vector<std::string> tonemapNames() {
    std::vector<std::string> names;
    for (const Curve& curve : kCurves) names.emplace_back(curve.name);
    return names;
}

Bitmap tonemapImage(const Bitmap& radiance, double exposureStops, const std::string& curve) {
    const uint32_t id = curveId(curve);
    const float scale = static_cast<float>(std::exp2(exposureStops));
    Bitmap display = radiance;
    for (size_t i = 0; i < display.pixelCount(); ++i) {
        float* p = display.pixels.data() + i * static_cast<size_t>(display.channels);
        const glm::vec3 mapped = shared::tonemap(glm::vec3(p[0], p[1], p[2]) * scale, id);
        for (int channel = 0; channel < 3; ++channel) p[channel] = mapped[channel];
    }
    return display;
}

}  // namespace raylab
