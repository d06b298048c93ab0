#pragma once

#include "engine/measure/stability/battery.h"
#include "shaders/shared/frame.h"

/// What the table of cases measures by; tests call some of them with rays and limits of their own.
namespace raylab::stability {

// Edges: cases_edges.cpp.
/// S1, one of the scenes 0 to 2: closed meshes at the origin and far away. A number each: leaks over rays.
std::vector<Number> measureLeaksOf(const Context& context, size_t scene, size_t rays);
std::vector<Number> measureLeaks(const Context& context);
/// S2: misses, double hits, and how short edges are.
std::vector<Number> measureSingleHit(const Context& context);
/// What brute force says of rays along axes, by the triangle test of the context.
struct AxisAnswers {
    std::vector<shared::RayData> rays;
    std::vector<shared::HitData> closest, occluded;
};
AxisAnswers axisAnswers(const Context& context, size_t count);
std::vector<Number> measureAxisRaysAgainst(const Context& context, const AxisAnswers& expected);
/// S7: rays that differ from brute force with the same triangle test; of the driver's tracers, wrong rays.
std::vector<Number> measureAxisRays(const Context& context);

// Shapes: cases_shapes.cpp.
/// S8: needles, wrong hits that no rounding excuses, those of exact arithmetic, wrong distances, non-finite ones,
/// degenerate triangles.
std::vector<Number> measureNeedles(const Context& context);
std::vector<Number> measureDegenerateFiles(const Context& context);
/// S12: wrong hits at scales of 1e-4 and 1e4, and of a bead beside a plane.
std::vector<Number> measureScales(const Context& context);
/// S27: wrong hits, and the error of t, from 1e6 units away.
std::vector<Number> measureFarRays(const Context& context);

// Origins of rays: cases_origins.cpp.
/// S4: pixels of planes at every scale that are not evenly lit; rays that hit the triangle they leave.
std::vector<Number> measurePlanes(const Context& context);
std::vector<Number> measureRandomTriangles(const Context& context);
/// S5: pixels that see light in closed, low boxes.
std::vector<Number> measureLowBoxes(const Context& context);
/// S6: the largest step of brightness across a coarse ball's terminator.
std::vector<Number> measureTerminator(const Context& context);
/// S28: rays that a leaf with holes stops on itself.
std::vector<Number> measureLeaves(const Context& context);
/// S29: unevenly lit pixels of planes scaled by 1e-6 and 1e6.
std::vector<Number> measureScaledInstances(const Context& context);
/// S30: how close to its lamp a shade lets light through.
std::vector<Number> measureShades(const Context& context);

// Trees: cases_trees.cpp.
/// S9: seconds to build 10,000 identical triangles, different trees in ten runs, hits that are not of the lowest id.
std::vector<Number> measureDuplicates(const Context& context);
/// S10: levels of trees above the cap; wrong hits, wrong shadow rays and entries of the stack beyond its end.
std::vector<Number> measureTreeDepth(const Context& context);
std::vector<Number> measureDepth(const Context& context);
std::vector<Number> measureStadium(const Context& context);
/// S11: wrong hits of instances with matrices of all kinds, hits of meshes without an instance.
std::vector<Number> measureInstances(const Context& context);
std::vector<Number> measureTrucks(const Context& context);
/// S24: nothing, and more than fits into one storage buffer.
std::vector<Number> measureEmpty(const Context& context);
std::vector<Number> measureLarge(const Context& context);

// Light that is found seldom or never: cases_fireflies.cpp.
/// S18: how far the slope of the error over samples is from -.5, what a clamp takes, and how bright fireflies are.
std::vector<Number> measureFireflies(const Context& context);
std::vector<Number> measureWaterCaustic(const Context& context);
/// S26: light behind glass that path tracing cannot find.
std::vector<Number> measureMissedCaustic(const Context& context);

// Light: cases_light.cpp.
/// S15: black and non-finite pixels of mirrors at grazing angles and of coarse smooth normals.
std::vector<Number> measureGrazing(const Context& context);
std::vector<Number> measureNormalTangentTest(const Context& context);
/// S16: error of the sum of facing mirrors' images at depths 4, 10 and 25; exponent of time over depth.
std::vector<Number> measureCorridor(const Context& context);
/// S17: light that clear glass makes of nothing, below a white sky.
std::vector<Number> measureGlass(const Context& context);
/// S19: GGX of alpha 1e-3 and 1e-4 against the mirror.
std::vector<Number> measureNearlySpecular(const Context& context);
/// S20: one flux over 1, 100 and 10,000 lights.
std::vector<Number> measureManyLights(const Context& context);

// What stands in for geometry: cases_shading.cpp.
/// S31: light that smooth normals of coarse balls lose, and make, below a white sky.
std::vector<Number> measureShadingNormals(const Context& context);
/// S32: means of textures with many texels a pixel, and noise of their samples.
std::vector<Number> measureFarTextures(const Context& context);

// Samples: cases_sampling.cpp.
/// S33: error of the mean of many samples that add up to what is exactly known.
std::vector<Number> measureManySamples(const Context& context);
/// S34: correlation of noise between pixels and between seeds, in standard errors.
std::vector<Number> measureCorrelation(const Context& context);

// Files: cases_files.cpp.
/// S3: FLIP of a truck at 1e4 and 1e6 against the origin; at 1e6 shown only where the importer warns.
std::vector<Number> measureFarFromOrigin(const Context& context);
/// S13: non-finite pixels of files with NaN, Inf and 1e30; files that nobody is told of.
std::vector<Number> measureBadValues(const Context& context);
/// S14: crashes and hangs of the program on malformed files, in a process each.
std::vector<Number> measureMalformedFiles(const Context& context);

// The device: cases_device.cpp.
/// S13: non-finite pixels of values that are legal but extreme.
std::vector<Number> measureExtremeValues(const Context& context);
/// S21: non-finite pixels of lights without an area, on surfaces and inside boxes, and of a camera inside glass.
std::vector<Number> measureDegenerateLights(const Context& context);
/// S22: values that differ from one run to the next, and by the length of dispatches.
std::vector<Number> measureDeterminism(const Context& context);
/// S22: pixels that fail the Z-test against another tracer, and pixels that differ from it on the same paths.
std::vector<Number> measureAgainstQuery(const Context& context);
std::vector<Number> measureAgainstPipeline(const Context& context);
/// S23: messages of validation, on a device of its own.
std::vector<Number> measureValidation(const Context& context);
/// S25: the longest submission.
std::vector<Number> measureSlowDispatch(const Context& context);

}  // namespace raylab::stability
