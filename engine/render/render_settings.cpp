#include "engine/render/render_settings.h"

#include "engine/accel/builders.h"
#include "engine/accel/layout.h"
#include "engine/render/denoise.h"
#include "engine/render/integrators.h"
#include "engine/render/sampling.h"
#include "engine/render/tonemap.h"
#include "engine/render/tracer.h"
#include "engine/render/triangle_record.h"
#include "engine/scene/bounds.h"

namespace raylab {
namespace {

std::vector<std::string> layoutChoices() {
    std::vector<std::string> choices = layoutNames();
    choices.emplace(choices.begin(), kAutoLayout);
    return choices;
}

}  // namespace

std::span<const Setting<RenderSettings>> renderSettingsTable() {
    using S = RenderSettings;
    static const std::vector<Setting<S>> table = {
        {"width", &S::width, "pixels", "width of the image", 1, 65536},
        {"height", &S::height, "pixels", "height of the image", 1, 65536},
        {"spp", &S::spp, "samples", "samples a pixel", 1, 4294967295.0},
        {"seed", &S::seed, "", "of all random numbers; the same seed gives the same bits", 0, 4294967295.0},
        {"depth", &S::depth, "events", "scattering events of a path at most", 0, 1e6},
        {"roulette-depth", &S::rouletteDepth, "events", "Russian roulette may end a path after so many", 0, 1e6},
        {"throughput-end", &S::throughputEnd, "", "path: share of the light under which Russian roulette may end a path at any bounce, in proportion and without bias; 0: off", 0, 1},
        {"integrator", &S::integrator, "", "method, or what to show of the first hit", 0, 0, integratorNames()},
        {"energy", &S::energy, "", "path: light scattered more than once between the microfacets of rough surfaces: lost (single) or given back (multiple)", 0, 0, {"single", "multiple"}},
        {"fresnel", &S::fresnel, "", "direct: Schlick's approximation, or the equations of dielectrics and metals", 0, 0, {"schlick", "exact"}},
        {"geometry", &S::geometry, "", "direct: masking and shadowing of microfacets", 0, 0, {"schlick-ggx-direct", "schlick-ggx-ibl", "smith-correlated", "smith-separable"}},
        {"alpha-mapping", &S::alphaMapping, "", "direct: from roughness to the alpha of GGX", 0, 0, {"squared", "linear"}},
        {"shadows", &S::shadows, "", "direct, whitted: of punctual lights; glass: dimmed and tinted by what they pass through (direct: hard)", 0, 0, {"none", "hard", "glass"}},
        {"mirror-roughness", &S::mirrorRoughness, "", "direct: surfaces less rough than this are mirrors", 0, 1},
        {"ao-rays", &S::aoRays, "rays", "ao: of a sample", 1, 65536},
        {"ao-distance", &S::aoDistance, "scene units", "ao: what is further away does not occlude; 0: everything does", 0, 1e30},
        {"ambient", &S::ambient, "radiance", "direct, whitted: light from everywhere that diffuse surfaces scatter; -1: a computed sky's mean, 0 without one", -1, 1e9},
        {"attenuation", &S::attenuation, "", "whitted: of point and spot lights: none, 1/d, 1/d^2, all 1 at distance d = 1", 0, 0, {"none", "linear", "quadratic"}},
        {"highlight", &S::highlight, "", "whitted: Phong's, or Blinn's with the half vector", 0, 0, {"phong", "blinn-phong"}},
        {"reflection", &S::reflection, "", "whitted: what is mirrored by the Fresnel equations, or by the material's fixed share", 0, 0, {"fresnel", "fixed"}},
        {"threshold", &S::threshold, "", "direct, whitted: a mirrored or refracted ray ends where its light counts less than this", 0, 1},
        {"beyond", &S::beyond, "", "whitted: what rays beyond --depth show: nothing, or the ambient light", 0, 0, {"black", "average"}},
        {"antialias", &S::antialias, "", "where samples lie in a pixel: by --filter; 1: all in the middle; 4: on a grid of four, in turn (--spp 4)", 0, 0, {"filter", "1", "4"}},
        {"tracer", &S::tracer, "", "how rays find triangles", 0, 0, tracerNames()},
        {"builder", &S::builder, "", "how the BVH over triangles is built", 0, 0, builderNames()},
        {"layout", &S::layout, "", "how the BVH is laid out for the kernel; auto: what bench --tune found best on the device, and bvh2 for 256 primitives and less", 0, 0, layoutChoices()},
        {"triangle", &S::triangle, "", "test of a ray and a triangle in the software tracers", 0, 0, triangleTestNames()},
        {"slab", &S::slab, "", "test of a ray and a box in the software tracers: padded for rounding and guarded against 0 times infinity, or neither", 0, 0, {"padded", "plain"}},
        {"offset", &S::offset, "", "of a ray's origin off the surface that it leaves: by bounds of the rounding errors, by units in the last place, or by offset-epsilon", 0, 0, {"error-bound", "ulp", "epsilon"}},
        {"offset-epsilon", &S::offsetEpsilon, "scene units", "along the normal, where the offset is epsilon", 0, 1e30},
        {"leaf-size", &S::leafSize, "triangles", "in a leaf of the BVH at most; layouts of blocks: 1", 1, kMaxLeafSize},
        {"bins", &S::bins, "", "of the binned and spatial builders (and auto, which takes one of them) on each axis", 2, kMaxBvhBins},
        {"traversal-cost", &S::traversalCost, "", "of a node, for the SAH", 0, 1e6},
        {"intersection-cost", &S::intersectionCost, "", "of a triangle, for the SAH, in the same unit", 1e-6, 1e6},
        {"spatial-budget", &S::spatialBudget, "", "duplicates that the spatial builder (and auto) may make, as a part of the triangles", 0, kMaxSpatialBudget},
        {"reinsertion", &S::reinsertion, "rounds", "of tree optimisation after the build at most", 0, 1e4},
        {"trees", &S::trees, "", "merged: one tree in world space as far as flatten-limit allows; mesh: one a mesh, and one over instances, which can be moved", 0, 0, {"merged", "mesh"}},
        {"flatten-limit", &S::flattenLimit, "triangles", "that a scene may show and still be one merged tree; beyond: a tree for each mesh that is shown more than once", 0, 1e12},
        {"bvh-cache", &S::bvhCache, "", "keep trees on disk, in $XDG_CACHE_HOME/raylab/bvh, and take them from there"},
        {"needs", &S::needs, "", "what the kernel contains: what the scene needs, or everything", 0, 0, {"scene", "full"}},
        {"camera", &S::camera, "", "number or name of a camera of the scene, or px,py,pz,tx,ty,tz,fov: position, target, vertical degrees"},
        {"camera-end", &S::cameraEnd, "", "the camera, as for --camera, at the end of its motion: motion blur; empty: it stands still"},
        {"shutter", &S::shutter, "", "part of the motion of camera and instances, from its start, while light is let in", 0, 1},
        {"sampler", &S::sampler, "", "random numbers of a pixel; stratified wants all of --spp, blue-noise few samples", 0, 0, samplerNames()},
        {"filter", &S::filter, "", "how a pixel weighs the image around it", 0, 0, filterNames()},
        {"filter-radius", &S::filterRadius, "pixels", "of the filter; 0: its usual (box 0.5, tent 1, blackman-harris and gaussian 1.5)", 0, 16},
        {"lens-radius", &S::lensRadius, "scene units", "of a thin lens: focal length / (2 x f-number); 0: a pinhole, all is sharp", 0, 1e6},
        {"focus-distance", &S::focusDistance, "scene units", "that is sharp, along the axis of view; 0: where the camera's target is", 0, 1e9},
        {"clamp", &S::clamp, "radiance", "cut samples at this largest component: fewer fireflies, light is lost (and reported); 0: off", 0, 1e30},
        {"light-choice", &S::lightChoice, "", "which light is sampled: by a tree over lights, by power, or uniformly (lamps by their area alone); auto: a tree where they are several, else by power", 0, 0, {"auto", "tree", "power", "uniform"}},
        {"denoise", &S::denoise, "", "takes noise out of the picture, with a bias that falls with the samples: by an edge-avoiding wavelet guided by first hits and by each pixel's variance (atrous); views stay as they are", 0, 0, denoiserNames()},
        {"time-limit", &S::timeLimit, "s", "stop rendering after so long, once every pixel has a sample; 0: no limit", 0, 1e9},
        {"target-error", &S::targetError, "", "stop where the estimated relative error is below; 0: no target", 0, 1e3},
        {"adaptive", &S::adaptive, "", "more samples where the picture is noisier; --spp is their mean, an eighth of it goes into finding out"},
        {"environment", &S::environment, "", "auto (the scene's, or a sky where nothing else gives light), none, sky, white, or an image file"},
        {"environment-scale", &S::environmentScale, "", "multiplies the environment's radiance", 0, 1e6},
        {"sun-elevation", &S::sunElevation, "degrees", "of a sky's sun above the horizon; -1: the scene's", -1, 90},
        {"sun-azimuth", &S::sunAzimuth, "degrees", "of a sky's sun, 0 at -Z, growing towards +X; -1: the scene's", -1, 360},
        {"exposure", &S::exposure, "stops", "doubles the brightness of PNG output for each stop", -64, 64},
        {"tonemap", &S::tonemap, "", "from radiance to PNG", 0, 0, tonemapNames()},
        {"slice-ms", &S::sliceMs, "ms", "aim of the time of one dispatch", 1, 400},
        {"schedule", &S::schedule, "", "path: one kernel follows a path to its end, or queues of paths between kernels that trace and that shade", 0, 0, {"mega", "wavefront"}},
        {"queue-order", &S::queueOrder, "", "wavefront: of the paths: as they come; by material before they are shaded; by the octant of their rays, or by origin and octant, before they are traced", 0, 0, {"arrival", "material", "octant", "origin"}},
        {"queue-paths", &S::queuePaths, "paths", "wavefront: under way at a time at most, also bounded by the device's storage buffers", 16384, 2097152},
        {"device", &S::device, "", "number or part of the name of a Vulkan device (raylab devices); empty: the fastest kind"},
        {"validation", &S::validation, "", "Vulkan core and synchronisation validation; a message makes the run fail"},
    };
    return table;
}

bool isTiny(const Scene& scene) {
    return triangleCount(scene).instanced + quadricCount(scene).instanced <= kTinyPrimitives;
}

TraceConfig traceConfig(const RenderSettings& settings, const Scene& scene) {
    TraceConfig config;
    config.builder = settings.builder;
    config.layout = settings.layout;
    if (settings.layout == kAutoLayout) config.layout = isTiny(scene) ? kTinyLayout : kDefaultLayout;
    config.triangle = settings.triangle;
    config.paddedSlab = settings.slab == "padded";
    config.bvh.maxLeafSize = static_cast<int>(settings.leafSize);
    config.bvh.bins = static_cast<int>(settings.bins);
    config.bvh.traversalCost = static_cast<float>(settings.traversalCost);
    config.bvh.intersectionCost = static_cast<float>(settings.intersectionCost);
    config.bvh.spatialBudget = static_cast<float>(settings.spatialBudget);
    config.reinsertionPasses = static_cast<int>(settings.reinsertion);
    config.trees = settings.trees == "mesh" ? Trees::mesh : Trees::merged;
    config.flattenLimit = static_cast<size_t>(settings.flattenLimit);
    config.cache = settings.bvhCache;
    return config;
}

}  // namespace raylab
