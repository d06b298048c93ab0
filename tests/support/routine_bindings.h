#pragma once

#include "engine/gpu/pipeline.h"
#include "shaders/shared/bindings.h"

namespace raylab::support {

/// What every kernel of tests/shaders reads and writes.
inline constexpr BindingInfo kRoutineFrame{shared::kBindFrame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};
inline constexpr BindingInfo kRoutineResult{shared::kBindHits, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

}  // namespace raylab::support
