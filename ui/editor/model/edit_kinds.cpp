#include "ui/editor/model/edit_kinds.h"

#include <algorithm>
#include <array>

namespace raylab::editor {
namespace {

struct SettingKind {
    std::string_view name;
    uint32_t kind;
};

/// Those that ask for less than other trees.
constexpr std::array kSettingKinds = {
    SettingKind{"exposure", kEditFilm},
    SettingKind{"tonemap", kEditFilm},
    SettingKind{"denoise", kEditFilm},
    SettingKind{"spp", kEditBudget},
    SettingKind{"time-limit", kEditBudget},
    SettingKind{"target-error", kEditBudget},
    SettingKind{"slice-ms", kEditBudget},
    SettingKind{"camera", kEditCamera},
    SettingKind{"lens-radius", kEditCamera},
    SettingKind{"focus-distance", kEditCamera},
    SettingKind{"environment", kEditEnvironment},
    SettingKind{"environment-scale", kEditEnvironment},
    SettingKind{"sun-elevation", kEditEnvironment},
    SettingKind{"sun-azimuth", kEditEnvironment},
    SettingKind{"width", kEditKernel},
    SettingKind{"height", kEditKernel},
    SettingKind{"seed", kEditKernel},
    SettingKind{"depth", kEditKernel},
    SettingKind{"roulette-depth", kEditKernel},
    SettingKind{"throughput-end", kEditKernel},
    SettingKind{"shutter", kEditKernel},
    SettingKind{"energy", kEditKernel},
    SettingKind{"offset", kEditKernel},
    SettingKind{"offset-epsilon", kEditKernel},
    SettingKind{"adaptive", kEditKernel},
    SettingKind{"integrator", kEditKernel | kEditLights},  // which lights are sampled goes with it
    SettingKind{"light-choice", kEditLights},
    SettingKind{"sampler", kEditKernel | kEditPrepared},
    SettingKind{"camera-end", kEditKernel | kEditPrepared},
    SettingKind{"fresnel", kEditKernel},
    SettingKind{"geometry", kEditKernel},
    SettingKind{"alpha-mapping", kEditKernel},
    SettingKind{"shadows", kEditKernel},
    SettingKind{"mirror-roughness", kEditKernel},
    SettingKind{"ao-rays", kEditKernel},
    SettingKind{"ao-distance", kEditKernel},
    SettingKind{"ambient", kEditKernel | kEditPrepared},
    SettingKind{"attenuation", kEditKernel},
    SettingKind{"highlight", kEditKernel},
    SettingKind{"reflection", kEditKernel},
    SettingKind{"threshold", kEditKernel},
    SettingKind{"beyond", kEditKernel},
    SettingKind{"antialias", kEditKernel},
    SettingKind{"filter", kEditKernel},
    SettingKind{"filter-radius", kEditKernel},
    SettingKind{"clamp", kEditKernel},
    SettingKind{"schedule", kEditKernel},
    SettingKind{"queue-order", kEditKernel},
    SettingKind{"queue-paths", kEditKernel},
    SettingKind{"device", kEditNothing},
    SettingKind{"validation", kEditNothing},
};

/// Whether triangles of the material need an alpha test differently.
bool changesCutOut(const Material& a, const Material& b) {
    if (a.alphaMode == AlphaMode::opaque && b.alphaMode == AlphaMode::opaque) return false;
    return a.alphaMode != b.alphaMode || a.alphaCutoff != b.alphaCutoff || a.alpha != b.alpha ||
           a.baseColorTexture != b.baseColorTexture;
}

uint32_t materialKinds(const Splice<Material>& splice) {
    if (splice.isEmpty()) return kEditNothing;
    uint32_t kinds = kEditMaterials;
    if (splice.before.size() != splice.after.size()) return kinds;  // added or removed: meshes say which they wear
    for (size_t i = 0; i < splice.before.size(); ++i) {
        const Material &a = splice.before[i], &b = splice.after[i];
        if (changesCutOut(a, b)) kinds |= kEditGeometry;
        if (a.emission != b.emission || a.emissionTexture != b.emissionTexture || a.doubleSided != b.doubleSided)
            kinds |= kEditLights;
    }
    return kinds;
}

uint32_t instanceKinds(const Splice<Instance>& splice) {
    if (splice.before.size() != splice.after.size()) return kEditGeometry;
    uint32_t kinds = kEditNothing;
    for (size_t i = 0; i < splice.before.size(); ++i) {
        if (splice.before[i].mesh != splice.after[i].mesh) return kEditGeometry;
        if (splice.before[i].objectToWorld != splice.after[i].objectToWorld ||
            splice.before[i].endToWorld != splice.after[i].endToWorld)
            kinds = kEditTransforms;
    }
    return kinds;
}

}  // namespace

uint32_t editKinds(const SceneDelta& delta) {
    uint32_t kinds = materialKinds(delta.materials) | instanceKinds(delta.instances);
    const auto note = [&kinds](bool isChanged, uint32_t kind) { kinds |= isChanged ? kind : uint32_t{kEditNothing}; };
    note(!delta.textures.isEmpty(), kEditMaterials | kEditGeometry);
    note(!delta.meshes.isEmpty(), kEditGeometry);
    note(std::any_of(delta.meshLabels.begin(), delta.meshLabels.end(),
                     [](const MeshLabelChange& label) { return label.materialBefore != label.materialAfter; }),
         kEditMaterials | kEditLights | kEditGeometry);
    note(!delta.cameras.isEmpty(), kEditCamera);
    note(!delta.lights.isEmpty(), kEditLights);
    note(delta.environment.isChanged || delta.sky.isChanged, kEditEnvironment);
    return kinds;
}

uint32_t editKinds(const Scene& before, const Scene& after) { return editKinds(difference(before, after)); }

uint32_t editKinds(const RenderSettings& before, const RenderSettings& after) {
    uint32_t kinds = kEditNothing;
    for (const Setting<RenderSettings>& setting : renderSettingsTable())
        if (getSetting(setting, before) != getSetting(setting, after)) kinds |= settingEditKind(setting.name);
    return kinds;
}

uint32_t settingEditKind(std::string_view name) {
    const auto found = std::find_if(kSettingKinds.begin(), kSettingKinds.end(),
                                    [name](const SettingKind& each) { return each.name == name; });
    return found == kSettingKinds.end() ? uint32_t{kEditTrees} : found->kind;
}

}  // namespace raylab::editor
