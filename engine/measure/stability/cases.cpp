#include "engine/measure/stability/cases.h"

#include <array>

namespace raylab::stability {
namespace {

constexpr unsigned kOrigins = kAxisTriangle | kAxisOffset | kAxisTracer;
constexpr unsigned kTraversal = kAxisTriangle | kAxisSlab | kAxisLayout | kAxisTracer | kAxisBrute;

constexpr std::array kCases = {
    Case{"S1", "light leaks at shared edges", kTraversal, measureLeaks},
    Case{"S2", "double and missing hits", kTraversal, measureSingleHit},
    Case{"S3", "far from the origin", kOrigins, measureFarFromOrigin},
    Case{"S4", "acne on planes", kOrigins, measurePlanes},
    Case{"S4", "rays that hit the triangle they leave", kOrigins, measureRandomTriangles},
    Case{"S5", "offsets that are too large", kOrigins, measureLowBoxes},
    Case{"S6", "shadow terminator", kAxisNone, measureTerminator},
    Case{"S7", "0 times infinity in the slab test", kTraversal, measureAxisRays},
    Case{"S8", "slivers", kTraversal, measureNeedles},
    Case{"S8", "degenerate triangles in files", kTraversal, measureDegenerateFiles},
    Case{"S9", "identical triangles", kTraversal, measureDuplicates},
    Case{"S10", "depth of trees", kAxisNone, measureTreeDepth},
    Case{"S10", "depth of walks", kTraversal, measureDepth},
    Case{"S10", "a dragon in a stadium", kTraversal, measureStadium},
    Case{"S11", "matrices of instances", kTraversal, measureInstances},
    Case{"S11", "a truck mirrored, sheared, singular", kTraversal, measureTrucks},
    Case{"S12", "ratio of scales", kTraversal, measureScales},
    Case{"S13", "NaN, Inf and 1e30 in files", kAxisTracer, measureBadValues},
    Case{"S13", "extreme values", kAxisTracer, measureExtremeValues},
    Case{"S14", "malformed files", kAxisNone, measureMalformedFiles},
    Case{"S15", "grazing angles", kAxisOffset | kAxisTracer, measureGrazing},
    Case{"S15", "shading normals", kAxisOffset | kAxisTracer, measureNormalTangentTest},
    Case{"S16", "corridor of mirrors", kAxisOffset | kAxisTracer, measureCorridor},
    Case{"S17", "glass nested, overlapping, open", kOrigins, measureGlass},
    Case{"S18", "fireflies", kAxisNone, measureFireflies},
    Case{"S18", "fireflies below water", kAxisNone, measureWaterCaustic},
    Case{"S19", "nearly specular GGX", kAxisNone, measureNearlySpecular},
    Case{"S20", "many lights", kAxisNone, measureManyLights},
    Case{"S21", "lights and cameras in odd places", kAxisTracer, measureDegenerateLights},
    Case{"S22", "determinism", kAxisTracer | kAxisLayout, measureDeterminism},
    Case{"S22", "software against ray query", kAxisNone, measureAgainstQuery},
    Case{"S22", "software against the ray tracing pipeline", kAxisNone, measureAgainstPipeline},
    Case{"S23", "misuse of Vulkan", kAxisNone, measureValidation},
    Case{"S24", "nothing at all", kTraversal, measureEmpty},
    Case{"S24", "more triangles than a buffer holds", kTraversal, measureLarge},
    Case{"S25", "slow dispatches", kAxisTracer, measureSlowDispatch},
    Case{"S26", "caustics that no path finds", kAxisNone, measureMissedCaustic},
    Case{"S27", "distances of 1e6", kTraversal, measureFarRays},
    Case{"S28", "leaves that shadow themselves", kOrigins, measureLeaves},
    Case{"S29", "instances of scale 1e-6 and 1e6", kOrigins, measureScaledInstances},
    Case{"S30", "shadow rays that end too early", kAxisNone, measureShades},
    Case{"S31", "normals that are not the triangles'", kOrigins, measureShadingNormals},
    Case{"S32", "many texels a pixel", kAxisTracer, measureFarTextures},
    Case{"S33", "sums of many samples", kAxisNone, measureManySamples},
    Case{"S34", "random numbers that know each other", kAxisNone, measureCorrelation},
};

}  // namespace

std::span<const Case> cases() { return kCases; }

}  // namespace raylab::stability
