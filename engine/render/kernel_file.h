#pragma once

#include <filesystem>
#include <string>

#include "engine/core/file.h"
#include "engine/render/tracer.h"

namespace raylab {

/// SPIR-V of an entry file, by its name.
inline std::filesystem::path shaderFile(const std::string& entry) { return dataFolder("shaders") / (entry + ".spv"); }

/// How the names of a kind's entry files begin.
inline std::string kernelPrefix(KernelKind kind) {
    switch (kind) {
        case KernelKind::render: return "render";
        case KernelKind::rays: return "rays";
        case KernelKind::wavefront: return "wavefront";
    }
    return {};
}

/// Of a compute kernel: render_NAME, rays_NAME or wavefront_NAME.
inline std::filesystem::path kernelFile(KernelKind kind, const std::string& name) {
    return shaderFile(kernelPrefix(kind) + "_" + name);
}

}  // namespace raylab
