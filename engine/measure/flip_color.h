#pragma once

#include <array>

namespace raylab::flip {

/// Colours in FLIP: linear sRGB, XYZ in units of the white point (D65), and L*a*b* with Hunt's adjustment.

using Color = std::array<float, 3>;

Color whiteRelativeXyz(const Color& linearRgb);
Color linearRgb(const Color& whiteRelativeXyz);

/// L*, and a* and b* times L*/100: the Hunt effect, chroma counts for less in the dark (FLIP, section 4.1).
Color huntLab(const Color& whiteRelativeXyz);

/// 0 to 1 from two Hunt-adjusted colours: their HyAB distance (Abasi, Tehran, Fairchild, "Distance Metrics for Very
/// Large Color Differences", 2020) to the power 0.7, of which 0.4 of what sRGB can show, green against blue, takes 0.95
/// (FLIP, section 4.1).
float colorError(const Color& a, const Color& b);

}  // namespace raylab::flip
