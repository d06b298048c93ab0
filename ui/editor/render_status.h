#pragma once

#include "engine/render/renderer.h"
#include "ui/editor/render_request.h"

namespace raylab {

/// What only changes with the kernel or the scene: times of preparing, needs, memory.
void describeKernel(const Renderer& renderer, RenderStatus& status);

/// What changes with every sample. Where `film` is given, its size and rays a second too.
void describeFilm(const Renderer& renderer, const RenderSettings& wanted, const FilmImage* film, RenderStatus& status);

/// Why a rendering should end before its samples are done, `noise` being its estimated relative error (negative: not
/// known); empty where it should go on.
std::string reasonToStop(const Renderer& renderer, const RenderSettings& wanted, double noise);

}  // namespace raylab
