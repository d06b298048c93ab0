#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace raylab {

/// 32 hexadecimal digits of everything in a scene that a picture can depend on (names and warnings are left out): files
/// that say the same in another way have the same. Not proof against an adversary.
std::string sceneHash(const Scene& scene);

}  // namespace raylab
