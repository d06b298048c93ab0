#pragma once

#include <string>
#include <vector>

#include "engine/render/render_settings.h"

/// What a software traversal can be made of.
namespace raylab::support {

/// The default settings with each of layouts().
std::vector<RenderSettings> everyLayout();

/// The default settings with each of layouts() and each of triangleTests().
std::vector<RenderSettings> everyLayoutAndTest();

/// Builder, layout, triangle test, and whether instances are kept.
std::string nameOf(const RenderSettings& settings);

/// The settings that keep a tree a mesh below instances, where a scene shows a mesh more than once.
RenderSettings twoLevels(RenderSettings settings);

/// The settings with the tracer that walks no tree.
RenderSettings bruteForce(RenderSettings settings);

}  // namespace raylab::support
