#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "engine/core/disk_cache.h"
#include "engine/gpu/pipeline.h"

namespace raylab {

/// The code of a SPIR-V file with its specialisation constants made plain, everything inlined into the entry point, and
/// all that the constants rule out taken away. A driver takes specialisation constants too, but reads, inlines and
/// simplifies all of the code before it drops any: on lavapipe that was 1.9 of the 2.0 seconds until a kernel of the
/// path tracer came from the driver's own cache. What was made is kept in the cache, by a hash of the file's bytes and
/// the constants. Throws Error where the file is missing or is not SPIR-V.
std::vector<uint32_t> specialisedCode(const std::filesystem::path& spirv, std::span<const SpecConstant> constants,
                                      const DiskCache& cache);

/// Of this process, in $XDG_CACHE_HOME/raylab/kernels.
const DiskCache& kernelCache();

}  // namespace raylab
