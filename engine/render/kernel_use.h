#pragma once

#include <string>
#include <string_view>

#include "engine/render/prepared_scene.h"

namespace raylab {

/// How rays find triangles: the name of the software tracer's layout, or of the tracer.
std::string traversalOf(const PreparedScene& prepared);

/// Whether kernels over a traversal may be made of an entry file, by its name without ".spv": not of those of another
/// traversal (kernel_file.h), nor of ray tracing stages unless that is the pipeline.
bool mayServe(std::string_view entry, std::string_view traversal);

}  // namespace raylab
