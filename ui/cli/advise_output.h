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
};

nlohmann::ordered_json adviceJson(const AdviceReport& report);

/// For --preset: the settings that the search chose, and what it expects of them.
nlohmann::ordered_json presetJson(const AdviceReport& report);

/// In sentences, to standard output.
void printAdvice(const AdviceReport& report);

}  // namespace raylab
