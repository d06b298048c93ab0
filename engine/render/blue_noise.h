#pragma once

#include <cstdint>
#include <vector>

namespace raylab {

/// A square mask of ranks 0 .. size^2 - 1, row by row, that tiles: pixels of neighbouring ranks lie far apart, so that
/// each threshold cuts out points of blue noise. Void and cluster: Ulichney, "The void-and-cluster method for dither
/// array generation", Proc. SPIE 1913, 1993. Always the same; takes about size^4 steps (64: some 20 ms).
std::vector<uint32_t> makeBlueNoise(uint32_t size);

}  // namespace raylab
