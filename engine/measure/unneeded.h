#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/measure/reference.h"
#include "engine/measure/statistics.h"
#include "engine/render/render_settings.h"
#include "engine/scene/scene.h"

namespace raylab {

/// What one light gives a picture by itself.
struct LightShare {
    std::string name;
    Interval share;  ///< mean radiance of the picture with this light alone, over that of the reference
};

/// Below this, a light has no effect that a display of 8 bits could show.
constexpr double kNoEffect = 1e-4;
/// Lights that are tried one by one; those of a scene with more are taken in the order of the file.
constexpr size_t kMostTriedLights = 24;

/// The share of each punctual light, each emitting material and the environment, by renderings with this light alone.
/// Nothing where `stop` says so. The scene's environment must not be settled.
std::optional<std::vector<LightShare>> lightShares(Device& device, const Scene& scene, const RenderSettings& settings,
                                                   const Reference& reference, const std::function<bool()>& stop);

/// A texture that is finer than the camera can see, wherever it lies in view.
struct FineTexture {
    std::string name;
    uint32_t width = 0, height = 0;
    double texelsPerPixel = 0.0;  ///< along one axis, where the picture comes closest to it
};

/// Textures of which more than two texels along an axis fall into a pixel everywhere in the camera's view, as it sees
/// them directly; what hides a surface is not taken into account, so that none is named wrongly for that.
/// The finest first.
std::vector<FineTexture> texturesBelowPixels(const Scene& scene, const RenderSettings& settings);

}  // namespace raylab
