#pragma once

#include <memory>
#include <vector>

#include "engine/measure/ray_bench.h"

namespace raylab {

/// Embree over the same triangles, one subject each way of asking it; none where raylab was built without Embree.
std::vector<std::unique_ptr<BenchSubject>> makeEmbreePeers(const WorldTriangles& world);

}  // namespace raylab
