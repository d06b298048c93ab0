#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/settings.h"
#include "engine/render/trace_data.h"
#include "engine/scene/scene.h"

namespace raylab {

constexpr const char* kNoDenoiser = "none";
/// The layout that resolveForDevice() replaces by what is best on a device, what it is where nothing is recorded, and
/// what it is for a scene of so few primitives that their tests count for more than the nodes above them.
constexpr std::string_view kAutoLayout = "auto";
constexpr std::string_view kDefaultLayout = "bvh4b";
constexpr std::string_view kTinyLayout = "bvh2";
constexpr size_t kTinyPrimitives = 256;

/// Every setting of a rendering with its default; renderSettingsTable() says the rest.
struct RenderSettings {
    int64_t width = 1280;
    int64_t height = 720;
    int64_t spp = 64;
    int64_t seed = 0;
    int64_t depth = 8;
    int64_t rouletteDepth = 3;
    double throughputEnd = 0.0;
    std::string integrator = "path";
    std::string energy = "single";
    std::string fresnel = "schlick";
    std::string geometry = "schlick-ggx-direct";
    std::string alphaMapping = "squared";
    std::string shadows = "glass";
    double mirrorRoughness = 0.05;
    int64_t aoRays = 4;
    double aoDistance = 0.0;
    double ambient = -1.0;
    std::string attenuation = "quadratic";
    std::string highlight = "phong";
    std::string reflection = "fresnel";
    double threshold = 1e-3;
    std::string beyond = "black";
    std::string antialias = "filter";
    std::string tracer = "software";
    std::string builder = std::string(kDefaultBuilder);
    std::string layout{kAutoLayout};
    std::string triangle = "watertight";
    std::string slab = "padded";
    std::string offset = "error-bound";
    double offsetEpsilon = 1e-3;
    int64_t leafSize = BvhConfig{}.maxLeafSize;
    int64_t bins = BvhConfig{}.bins;
    double traversalCost = double{BvhConfig{}.traversalCost};
    double intersectionCost = double{BvhConfig{}.intersectionCost};
    double spatialBudget = double{BvhConfig{}.spatialBudget};
    int64_t reinsertion = 0;
    std::string trees = "merged";
    int64_t flattenLimit = static_cast<int64_t>(TreePlanConfig{}.flattenLimit);
    bool bvhCache = false;
    std::string needs = "scene";
    std::string camera = "0";
    std::string cameraEnd;
    double shutter = 1.0;
    std::string sampler = "sobol";
    std::string filter = "box";
    double filterRadius = 0.0;
    double lensRadius = 0.0;
    double focusDistance = 0.0;
    double clamp = 0.0;
    std::string lightChoice = "auto";
    std::string denoise = kNoDenoiser;
    double timeLimit = 0.0;
    double targetError = 0.0;
    bool adaptive = false;
    std::string environment = "auto";
    double environmentScale = 1.0;
    double sunElevation = -1.0;
    double sunAzimuth = -1.0;
    double exposure = 0.0;
    std::string tonemap = "filmic";
    double sliceMs = 100.0;
    std::string schedule = "mega";
    std::string queueOrder = "arrival";
    int64_t queuePaths = 262144;
    std::string device = "";
    bool validation = false;
};

std::span<const Setting<RenderSettings>> renderSettingsTable();

/// Whether a scene shows at most kTinyPrimitives.
bool isTiny(const Scene& scene);

/// The settings that the trees of a software traversal are built by; kTinyLayout or kDefaultLayout where the layout is not
/// resolved.
TraceConfig traceConfig(const RenderSettings& settings, const Scene& scene);

}  // namespace raylab
