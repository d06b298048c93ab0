#pragma once

#include "ui/editor/model/document.h"

namespace raylab::editor {

/// Adds all that `other` holds, moved by `placement`; sun, sky and radiance map only where the scene has neither. The
/// instances that came are selected. Names stay as they are.
Edit mergeScene(Scene other, const glm::mat4& placement = glm::mat4(1.0f));

}  // namespace raylab::editor
