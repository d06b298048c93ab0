#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/measure/advise.h"
#include "engine/measure/unneeded.h"

namespace raylab {

/// What raylab advise has to say.
struct AdviceReport {
    std::string scene;
    std::string device;
    AdviceGoal goal;
    RenderSettings base;
    Reference reference;
    Advice advice;
    std::vector<LightShare> lights;
    std::vector<FineTexture> textures;
    bool isComplete = false;  ///< the search came to its end: there is a forecast
    std::string deviceLoss;  ///< what the driver said when it ended the search; empty: the search came through
};

nlohmann::ordered_json adviceJson(const AdviceReport& report);

/// For --preset: the settings that the search chose, and what it expects of them.
nlohmann::ordered_json presetJson(const AdviceReport& report);

/// "x 1.4 (1.2 to 1.7)": how many times as fast; or what infinity and 0 stand for.
std::string gainText(const Interval& gain);
/// Of a step that chose what was held.
std::string keptText(const AdviceStep& step);

/// Samples, time and error; or why there is none.
std::string forecastText(const Forecast& forecast);

/// In sentences, to standard output; of a search that did not come to its end, the steps alone.
void printAdvice(const AdviceReport& report);

}  // namespace raylab
