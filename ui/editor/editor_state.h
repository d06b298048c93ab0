#pragma once

#include <memory>

#include "ui/editor/model/document.h"

namespace raylab {

/// What is edited, and how it is looked at.
struct EditorState {
    std::unique_ptr<editor::Document> document;  ///< nullptr before the first scene has been opened
    RenderSettings startSettings;                ///< of the command line: those of every document that is opened
    Camera camera;                               ///< of the viewport; its target is the pivot

    bool hasScene() const { return document != nullptr; }
    const Scene& scene() const { return document->scene(); }
    const RenderSettings& settings() const { return document != nullptr ? document->settings() : startSettings; }
};

}  // namespace raylab
