#pragma once

#include <string>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/render/render_settings.h"

/// What a software traversal can be made of.
namespace raylab::support {

/// The default settings with each of layouts().
std::vector<RenderSettings> everyLayout();

/// The default settings with each of layouts() and each of triangleTests().
std::vector<RenderSettings> everyLayoutAndTest();

/// Tracer, builder, layout, triangle test, and whether instances are kept.
std::string nameOf(const RenderSettings& settings);

/// The settings that keep a tree a mesh below instances, where a scene shows a mesh more than once.
RenderSettings twoLevels(RenderSettings settings);

/// The default settings with each tracer that the device runs, by trees of each kind.
std::vector<RenderSettings> everyTracer(const DeviceDescription& device);

/// Those over the driver's structures alone.
std::vector<RenderSettings> hardwareTracers(const DeviceDescription& device);

/// What the default device, which programs under test take, lacks for a tracer; empty where it runs it.
std::string missingByDefault(const std::string& tracer);

/// Skips a test of the whole program where the default device lacks what a hardware tracer needs: not every GPU has ray
/// query, and lavapipe has it from Mesa 24.1 on.
#define RAYLAB_NEEDS_TRACER(tracer) \
    if (const std::string missing = raylab::support::missingByDefault(tracer); !missing.empty()) GTEST_SKIP() << missing

/// The settings with the tracer that walks no tree.
RenderSettings bruteForce(RenderSettings settings);

}  // namespace raylab::support
