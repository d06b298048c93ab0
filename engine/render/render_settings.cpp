#include "engine/render/render_settings.h"

#include "engine/render/integrators.h"
#include "engine/render/tonemap.h"
#include "engine/render/tracer.h"

namespace raylab {

std::span<const Setting<RenderSettings>> renderSettingsTable() {
    using S = RenderSettings;
    static const std::vector<Setting<S>> table = {
        {"width", &S::width, "pixels", "width of the image", 1, 65536},
        {"height", &S::height, "pixels", "height of the image", 1, 65536},
        {"spp", &S::spp, "samples", "samples a pixel", 1, 4294967295.0},
        {"seed", &S::seed, "", "of all random numbers; the same seed gives the same bits", 0, 4294967295.0},
        {"depth", &S::depth, "events", "scattering events of a path at most", 0, 1e6},
        {"roulette-depth", &S::rouletteDepth, "events", "Russian roulette may end a path after so many", 0, 1e6},
        {"integrator", &S::integrator, "", "method, or what to show of the first hit", 0, 0, integratorNames()},
        {"tracer", &S::tracer, "", "how rays find triangles", 0, 0, tracerNames()},
        {"needs", &S::needs, "", "what the kernel contains: what the scene needs, or everything", 0, 0, {"scene", "full"}},
        {"camera", &S::camera, "", "number or name of a camera of the scene, or px,py,pz,tx,ty,tz,fov: position, target, vertical degrees"},
        {"time-limit", &S::timeLimit, "s", "stop rendering after so long, once every pixel has a sample; 0: no limit", 0, 1e9},
        {"target-error", &S::targetError, "", "stop where the estimated relative error is below; 0: no target", 0, 1e3},
        {"environment", &S::environment, "", "auto (the scene's, or a sky where nothing else gives light), none, sky, white, or an image file"},
        {"environment-scale", &S::environmentScale, "", "multiplies the environment's radiance", 0, 1e6},
        {"sun-elevation", &S::sunElevation, "degrees", "of a sky's sun above the horizon; -1: the scene's", -1, 90},
        {"sun-azimuth", &S::sunAzimuth, "degrees", "of a sky's sun, 0 at -Z, growing towards +X; -1: the scene's", -1, 360},
        {"exposure", &S::exposure, "stops", "doubles the brightness of PNG output for each stop", -64, 64},
        {"tonemap", &S::tonemap, "", "from radiance to PNG", 0, 0, tonemapNames()},
        {"slice-ms", &S::sliceMs, "ms", "aim of the time of one dispatch", 1, 400},
        {"device", &S::device, "", "number or part of the name of a Vulkan device (raylab devices); empty: the fastest kind"},
        {"validation", &S::validation, "", "Vulkan core and synchronisation validation; a message makes the run fail"},
    };
    return table;
}

}  // namespace raylab
