#pragma once

#include <string>

#include "engine/measure/stability/plot.h"

namespace raylab {

/// An <svg> element of 340 x 250 pixels without anything from outside: axes with numbers, series in colours that the
/// colour-blind tell apart, their names where there are several.
std::string plotSvg(const stability::Plot& plot);

}  // namespace raylab
