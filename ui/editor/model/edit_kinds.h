#pragma once

#include <cstdint>

#include "ui/editor/model/delta.h"

namespace raylab::editor {

/// What of a rendering an edit touches, so that the renderer does the least; a mask.
enum SceneEditKind : uint32_t {
    kEditNothing = 0,
    kEditFilm = 1,          ///< from the film to the screen: exposure, tone curve
    kEditBudget = 2,        ///< when to stop: the samples there are stay
    kEditCamera = 4,        ///< view and lens
    kEditTransforms = 8,    ///< matrices of instances, and nothing else of them
    kEditMaterials = 16,    ///< materials and textures
    kEditLights = 32,       ///< punctual lights, and what emits
    kEditEnvironment = 64,  ///< radiance map, sky, and the settings of both
    kEditGeometry = 128,    ///< meshes, which instances there are, which triangles are cut out by alpha
    kEditKernel = 256,      ///< a setting that calls for another kernel or film
    kEditTrees = 512,       ///< a setting that calls for other trees, or for another tracer
    kEditPrepared = 1024,   ///< a setting that the prepared scene keeps, beside those of trees and lights
    kEditEverything = 2047,
    /// What the prepared scene keeps beside geometry, matrices and trees.
    kEditShading = kEditMaterials | kEditLights | kEditEnvironment | kEditPrepared,
};

/// From one rendered scene to the next.
uint32_t editKinds(const SceneDelta& delta);
uint32_t editKinds(const Scene& before, const Scene& after);

uint32_t editKinds(const RenderSettings& before, const RenderSettings& after);

/// Of a row of renderSettingsTable(). One that is not known counts as kEditTrees, which is always right.
uint32_t settingEditKind(std::string_view name);

}  // namespace raylab::editor
