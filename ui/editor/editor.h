#pragma once

#include <filesystem>
#include <string>

#include "engine/core/error.h"
#include "engine/render/render_settings.h"

namespace raylab {

struct EditorOptions {
    std::filesystem::path scene;  ///< empty: none is opened
    RenderSettings settings;
    std::filesystem::path script;  ///< of commands that are run instead of a user's; empty: none
};

/// Opens the window and lets the user work until it is closed. Throws Error (exit code 3) where there is no display or
/// no device. Returns checkFailed where a script's check failed, or where validation was asked for and had something to
/// say.
ExitCode runEditor(const EditorOptions& options);

}  // namespace raylab
