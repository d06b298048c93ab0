#include "ui/report/advise_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <ranges>

#include "ui/report/chart_output.h"
#include "ui/report/settings_file.h"

namespace raylab {
namespace {

std::string percent(double share) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g %%", 100.0 * share);
    return text.data();
}

nlohmann::ordered_json finite(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json intervalJson(const Interval& interval) {
    return {{"value", finite(interval.value)}, {"low", finite(interval.low)}, {"high", finite(interval.high)}};
}

nlohmann::ordered_json forecastJson(const Forecast& forecast) {
    if (forecast.samples == 0) return {{"reached", false}, {"relativeBias", forecast.relativeBias}};
    return {{"reached", true},
            {"samples", forecast.samples},
            {"deviceSeconds", forecast.seconds},
            {"relativeError", forecast.relativeError},
            {"relativeBias", forecast.relativeBias}};
}

nlohmann::ordered_json stepJson(const AdviceStep& step) {
    nlohmann::ordered_json options = nlohmann::ordered_json::array();
    for (const AdviceOption& option : step.options)
        options.push_back({{"value", option.value},
                           {"gain", intervalJson(option.gain)},
                           {"relativeBias", option.relativeBias},
                           {"energy", option.energy},
                           {"buildSeconds", option.buildSeconds}});
    return {{"setting", step.setting}, {"before", step.held}, {"chosen", step.chosen}, {"options", options}};
}

void printStep(const AdviceStep& step) {
    std::cout << "  " << step.setting << " " << step.chosen;
    if (step.chosen == step.held) {
        std::cout << ", " << keptText(step) << "\n";
    } else {
        const auto chosen = std::ranges::find(step.options, step.chosen, &AdviceOption::value);
        std::cout << " instead of " << step.held << ": " << gainText(chosen->gain) << "\n";
    }
    for (const AdviceOption& option : step.options) {
        if (option.value == step.held || option.value == step.chosen) continue;
        std::cout << "      " << option.value << ": " << gainText(option.gain);
        if (option.relativeBias > 0.0) std::cout << ", relative bias " << shortNumber(option.relativeBias);
        std::cout << "\n";
    }
}

/// The least depth whose picture has all of the light, to what an 8-bit display can show.
void printDepth(const std::vector<AdviceStep>& steps) {
    const auto step = std::ranges::find(steps, "depth", &AdviceStep::setting);
    if (step == steps.end()) return;
    std::cout << "  light by depth:";
    std::vector<AdviceOption> options = step->options;
    std::ranges::sort(options, {}, [](const AdviceOption& option) { return std::stoll(option.value); });
    for (const AdviceOption& option : options) std::cout << "  " << option.value << ": " << percent(option.energy);
    std::cout << "\n";
}

/// Lines of textures that are printed; a scene can have hundreds.
constexpr size_t kMostTextureLines = 5;

void printUnneeded(const AdviceReport& report) {
    std::cout << "What the scene does not need\n";
    printDepth(report.advice.steps);
    size_t idle = 0;
    for (const LightShare& light : report.lights)
        if (light.share.high < kNoEffect) {
            ++idle;
            std::cout << "  " << light.name << " has no effect: it gives " << percent(light.share.value)
                      << " of the light\n";
        }
    if (idle == 0) std::cout << "  every light that was tried (" << report.lights.size() << ") has an effect\n";
    for (const FineTexture& texture : report.textures | std::views::take(kMostTextureLines))
        std::cout << "  texture " << texture.name << " (" << texture.width << " x " << texture.height << ") has "
                  << shortNumber(texture.texelsPerPixel) << " texels or more along each pixel\n";
    if (report.textures.size() > kMostTextureLines)
        std::cout << "  and " << report.textures.size() - kMostTextureLines
                  << " more textures have 2 or more; --json names them all\n";
}

}  // namespace

std::string gainText(const Interval& gain) {
    if (gain.value == 0.0) return "does not come to the goal in that time";
    if (std::isinf(gain.value)) return "reaches the error, which the former does not";
    return "x " + shortNumber(gain.value) + " (" + shortNumber(gain.low) + " to " + shortNumber(gain.high) + ")";
}

std::string keptText(const AdviceStep& step) {
    return std::ranges::any_of(step.options, isWorthwhile) ? "as before: no gain with what was chosen later"
                                                           : "as before: nothing gains";
}

std::string forecastText(const Forecast& forecast) {
    if (forecast.samples == 0) return "never, its relative bias is " + shortNumber(forecast.relativeBias);
    return std::to_string(forecast.samples) + " samples, " + secondsText(forecast.seconds) + ", relative error " +
           shortNumber(forecast.relativeError);
}

nlohmann::ordered_json adviceJson(const AdviceReport& report) {
    nlohmann::ordered_json steps = nlohmann::ordered_json::array(), lights = steps, textures = steps;
    for (const AdviceStep& step : report.advice.steps) steps.push_back(stepJson(step));
    for (const LightShare& light : report.lights)
        lights.push_back({{"name", light.name}, {"share", intervalJson(light.share)}});
    for (const FineTexture& t : report.textures)
        textures.push_back(
            {{"name", t.name}, {"width", t.width}, {"height", t.height}, {"texelsPerPixel", t.texelsPerPixel}});
    nlohmann::ordered_json json{
        {"schema", "raylab.advise/1"},
        {"version", RAYLAB_VERSION},
        {"scene", report.scene},
        {"device", report.device},
        {"targetError", report.goal.relativeError},
        {"timeLimit", report.goal.seconds},
        {"reference", {{"from", report.reference.origin}, {"relativeError", report.reference.relativeError}}},
        {"settings", settingsJson(report.advice.settings)},
        {"deviceLoss", report.deviceLoss},
        {"complete", report.isComplete},
        {"steps", steps}};
    if (!report.isComplete) return json;
    json["isDefault"] = report.advice.isStandard;
    json["forecast"] = forecastJson(report.advice.forecast);
    json["default"] = forecastJson(report.advice.standard);
    json["achieved"] = {{"deviceSeconds", report.advice.achieved.seconds},
                        {"relativeError", report.advice.achieved.relativeError}};
    json["lights"] = lights;
    json["texturesBelowPixels"] = textures;
    return json;
}

nlohmann::ordered_json presetJson(const AdviceReport& report) {
    nlohmann::ordered_json settings = nlohmann::ordered_json::object();
    const nlohmann::ordered_json all = settingsJson(report.advice.settings);
    for (const Setting<RenderSettings>& setting : renderSettingsTable()) {
        const bool isOfTheMachine = setting.name == "device" || setting.name == "validation";
        const bool isDefault = getSetting(setting, report.advice.settings) == getSetting(setting, RenderSettings{});
        if (!isDefault && !isOfTheMachine && setting.name != "seed") settings[setting.name] = all[setting.name];
    }
    for (const AdviceStep& step : report.advice.steps) settings[step.setting] = all[step.setting];
    settings["spp"] = report.advice.settings.spp;
    return {{"schema", "raylab.preset/1"},
            {"scene", report.scene},
            {"device", report.device},
            {"forecast", forecastJson(report.advice.forecast)},
            {"settings", settings}};
}

void printAdvice(const AdviceReport& report) {
    const Advice& advice = report.advice;
    std::cout << "What it chose, each by its gain: time to the same error before, over that after\n";
    for (const AdviceStep& step : advice.steps) printStep(step);
    if (!report.isComplete) return;
    printUnneeded(report);
    if (advice.isStandard) std::cout << "All of that together would gain nothing: what the search began with is advised\n";
    std::cout << "Forecast\n";
    std::cout << "  advised: " << forecastText(advice.forecast) << "\n  default: " << forecastText(advice.standard) << "\n"
              << "  achieved by one run: " << secondsText(advice.achieved.seconds) << ", relative error "
              << shortNumber(advice.achieved.relativeError) << "\n"
              << "raylab render " << shellQuoted(report.scene) << settingsAsOptions(advice.settings) << " --spp "
              << advice.settings.spp << "\n";
}

}  // namespace raylab
