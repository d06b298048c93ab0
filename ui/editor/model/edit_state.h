#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/render/render_settings.h"
#include "engine/scene/scene.h"

namespace raylab::editor {

/// What is selected, as indices into the scene. `instances` is in the order of selection; the last one is the active
/// one.
struct Selection {
    std::vector<uint32_t> instances;
    std::optional<uint32_t> material;
    std::optional<uint32_t> light;
    std::optional<uint32_t> camera;

    bool operator==(const Selection&) const = default;
};

/// Everything that undo covers.
struct EditState {
    Scene scene;
    std::vector<uint8_t> hidden;  ///< as long as scene.instances; 1: not rendered
    RenderSettings settings;
    Selection selection;
};

}  // namespace raylab::editor
