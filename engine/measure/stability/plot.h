#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace raylab::stability {

/// Points of a plot, in the order in which a line joins them.
struct PlotSeries {
    std::string name;
    std::vector<glm::dvec2> points;
    bool isLine = true;  ///< false: points alone
};

/// How a number comes about: what reports draw.
struct Plot {
    std::string xLabel;  ///< with the unit
    std::string yLabel;
    bool logX = true;  ///< logarithmic; what is not positive is drawn at the low end
    bool logY = true;
    std::vector<PlotSeries> series;
};

}  // namespace raylab::stability
