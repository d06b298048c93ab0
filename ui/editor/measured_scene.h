#pragma once

#include <memory>
#include <string>

#include "ui/editor/context.h"

namespace raylab {

/// The document's scene as the viewport shows it, for what measures it.
struct MeasuredScene {
    std::shared_ptr<const Scene> scene;
    std::string camera;  ///< the setting that shows what the viewport does
};

/// A view that is none of the scene's cameras is named by its numbers, so that the commands of a report can name it;
/// where it is not upright it is put before the cameras of a copy.
MeasuredScene measuredScene(const EditorContext& context);

/// `settings` for pictures of so many pixels a row by the view and the aspect of `document`, and on its device, without
/// an end by time or error.
RenderSettings measuredSettings(RenderSettings settings, const RenderSettings& document, const std::string& camera,
                                int width);

/// "Chart  42 %"
std::string progressText(const std::string& what, double done);

}  // namespace raylab
