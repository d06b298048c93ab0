#include "engine/render/render_constants.h"

#include <algorithm>
#include <bit>

#include "engine/core/error.h"
#include "engine/render/integrators.h"
#include "shaders/shared/bindings.h"

namespace raylab {

uint32_t choiceIndex(const RenderSettings& settings, const std::string& name) {
    const Setting<RenderSettings>& setting = findSetting(renderSettingsTable(), name);
    const std::string value = settingText(getSetting(setting, settings));
    const auto found = std::ranges::find(setting.choices, value);
    if (found == setting.choices.end()) throw Error("--" + name + ": '" + value + "' is none of its choices");
    return static_cast<uint32_t>(found - setting.choices.begin());
}

std::vector<SpecConstant> renderConstants(const RenderSettings& settings) {
    return {{shared::kSpecIntegrator, findIntegrator(settings.integrator).id},
            {shared::kSpecEnergy, choiceIndex(settings, "energy")},
            {shared::kSpecFresnel, choiceIndex(settings, "fresnel")},
            {shared::kSpecGeometry, choiceIndex(settings, "geometry")},
            {shared::kSpecAlpha, choiceIndex(settings, "alpha-mapping")},
            {shared::kSpecShadows, choiceIndex(settings, "shadows")},
            {shared::kSpecSampler, choiceIndex(settings, "sampler")},
            {shared::kSpecFilter, choiceIndex(settings, "filter")},
            {shared::kSpecThinLens, settings.lensRadius > 0.0 ? 1u : 0u},
            {shared::kSpecCameraMotion, settings.cameraEnd.empty() ? 0u : 1u},
            {shared::kSpecAdaptive, settings.adaptive ? 1u : 0u},
            {shared::kSpecClamp, settings.clamp > 0.0 ? 1u : 0u},
            {shared::kSpecAttenuation, choiceIndex(settings, "attenuation")},
            {shared::kSpecHighlight, choiceIndex(settings, "highlight")},
            {shared::kSpecReflection, choiceIndex(settings, "reflection")},
            {shared::kSpecBeyond, choiceIndex(settings, "beyond")},
            {shared::kSpecAntialias, choiceIndex(settings, "antialias")},
            {shared::kSpecOffset, choiceIndex(settings, "offset")},
            {shared::kSpecOffsetEpsilon, std::bit_cast<uint32_t>(static_cast<float>(settings.offsetEpsilon))}};
}

}  // namespace raylab
