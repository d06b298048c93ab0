#pragma once

#include <string>

#include "ui/editor/render_session.h"

namespace raylab {

/// The thread of a RenderSession, from its first request to its end. It and all threads that its device starts yield to
/// others (a nice value), so that the interface keeps answering on a machine whose processors render.
///
/// A request is met by the least that it takes: another camera starts the film over, surfaces and lights are packed
/// anew, instances move within a tree over them, and only other geometry is prepared from nothing. While the request
/// says moving, the picture has a half, a quarter or an eighth of the width and height, as the time that a sample was
/// measured to take allows; at rest a full one grows over it.
void runRenderWorker(RenderSession& session, const std::string& deviceSelector, bool validation);

}  // namespace raylab
