#pragma once

#include <optional>
#include <span>
#include <vector>

#include "shaders/shared/frame.h"
#include "tests/support/trace_oracle.h"

namespace raylab::support {

/// Closest hits by Embree (Wald et al., SIGGRAPH 2014) in its robust mode: ids as in `flat`, t, u and v as ours.
/// Nothing where the tests were built without it.
std::optional<std::vector<shared::HitData>> embreeHits(const Flattened& flat, std::span<const shared::RayData> rays);

}  // namespace raylab::support
