#pragma once

#include "ui/editor/context.h"

namespace raylab {

struct Chart;

/// The error that the dial points at.
double targetOf(EditorContext& context);

/// The dial alone, as wide as the next item; `format` of its percents.
void drawTargetSlider(EditorContext& context, const char* format);

/// ImGui's units that drawTargetDial() takes.
float targetDialHeight();

/// A dial of the error that is good enough: what it will cost for the film that grows, and which settings of the chart
/// (nullptr: none) are the cheapest for it. A button makes the rendering stop there.
void drawTargetDial(EditorContext& context, const Chart* chart);

}  // namespace raylab
