#pragma once

#include <imgui.h>

#include "ui/editor/context.h"

namespace raylab {

/// A small picture of a texture, `side` wide and high, as an item of the layout or at a place of the window. It is made
/// when it is first seen.
void drawThumbnail(EditorContext& context, const Texture& texture, float side);
void drawThumbnailAt(EditorContext& context, const Texture& texture, const ImVec2& at, float side);

}  // namespace raylab
