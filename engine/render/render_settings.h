#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/core/settings.h"

namespace raylab {

/// Every setting of a rendering with its default; renderSettingsTable() says the rest.
struct RenderSettings {
    int64_t width = 1280;
    int64_t height = 720;
    int64_t spp = 64;
    int64_t seed = 0;
    int64_t depth = 8;
    int64_t rouletteDepth = 3;
    std::string integrator = "path";
    std::string tracer = "software";
    std::string needs = "scene";
    std::string camera = "0";
    double timeLimit = 0.0;
    double targetError = 0.0;
    std::string environment = "auto";
    double environmentScale = 1.0;
    double sunElevation = -1.0;
    double sunAzimuth = -1.0;
    double exposure = 0.0;
    std::string tonemap = "filmic";
    double sliceMs = 100.0;
    std::string device = "";
    bool validation = false;
};

std::span<const Setting<RenderSettings>> renderSettingsTable();

}  // namespace raylab
