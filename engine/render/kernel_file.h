#pragma once

#include <filesystem>
#include <string>

#include "engine/core/file.h"
#include "engine/render/tracer.h"

namespace raylab {

/// SPIR-V of an entry file, by its name.
inline std::filesystem::path shaderFile(const std::string& entry) { return dataFolder("shaders") / (entry + ".spv"); }

/// Of a kernel: render_NAME or rays_NAME.
inline std::filesystem::path kernelFile(KernelKind kind, const std::string& name) {
    return shaderFile((kind == KernelKind::render ? "render_" : "rays_") + name);
}

}  // namespace raylab
