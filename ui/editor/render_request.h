#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/render/film.h"
#include "engine/render/render_settings.h"
#include "engine/scene/needs.h"
#include "engine/scene/scene.h"
#include "ui/editor/hit_map.h"

namespace raylab {

struct DeviceDescription;

/// What the viewport wants to show.
struct RenderRequest {
    std::shared_ptr<const Scene> scene;
    RenderSettings settings;
    Camera camera;
    uint32_t width = 0;  ///< of the picture, pixels
    uint32_t height = 0;
    bool moving = false;  ///< a quick picture now is worth more than a good one later
    bool wantsHits = false;  ///< pictures should know what lies behind their pixels
};

enum class RenderPhase { idle, preparing, rendering, paused, done };

/// How the session is getting on.
struct RenderStatus {
    RenderPhase phase = RenderPhase::idle;
    std::string text;   ///< what is being prepared, or why it is done
    std::string error;  ///< why the last request could not be fulfilled; empty where it could
    std::string recovery;  ///< what goes on after a loss of the device; empty where there was none
    uint32_t samples = 0;
    uint32_t samplesWanted = 0;
    double relativeError = -1.0;  ///< estimated; negative where it is not known
    double raysPerSecond = 0.0;
    double seconds = 0.0;      ///< of rendering
    double secondsLeft = 0.0;  ///< until the samples that are wanted
    double buildSeconds = 0.0, uploadSeconds = 0.0, compileSeconds = 0.0;
    double longestDispatch = 0.0;
    uint32_t width = 0, height = 0;  ///< that is rendered
    uint32_t divisor = 1;            ///< of the width and height that were asked for
    size_t sceneBytes = 0, traceBytes = 0, filmBytes = 0;
    std::vector<Need> needs;
    uint32_t kernelNeeds = 0;
    std::string tracer;
    std::string device;
    std::shared_ptr<const DeviceDescription> deviceDescription;  ///< nullptr before there is a device
};

/// What a rendering looks like on a display.
struct Picture {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> texels;  ///< R in the lowest byte
    Camera camera;                 ///< that it was seen by
    uint32_t samples = 0;          ///< that every pixel has; 0 where some have none yet
    uint64_t number = 0;           ///< counts pictures
    double seconds = 0.0;          ///< of rendering, and of the device for taking the noise out, that are in it
    std::shared_ptr<const FilmImage> film;  ///< that it shows; pixels without samples are black there
    std::shared_ptr<const HitMap> hits;     ///< nullptr where it was not asked for
};

/// What lies behind a point of the picture.
struct PickResult {
    uint64_t ticket = 0;  ///< which pick this answers
    bool hit = false;
    uint32_t instance = 0;
    uint32_t primitive = 0;
    glm::vec3 position{0.0f};
    float distance = 0.0f;
};

}  // namespace raylab
