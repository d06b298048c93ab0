#pragma once

#include "engine/scene/gltf_document.h"

namespace raylab {

/// Throws Error, naming the place in the file, unless every index, byte range and required extension is one that the
/// importer can follow. Assimp 5.2.5 checks few of these and crashes on some files that break them.
void validateGltf(const GltfDocument& document);

}  // namespace raylab
