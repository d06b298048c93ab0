#include "engine/render/integrators.h"

#include <array>

#include "engine/core/error.h"
#include "shaders/shared/frame.h"

namespace raylab {
namespace {

constexpr std::array kIntegrators = {
    IntegratorInfo{"path", shared::kIntegratorPath, "path tracing: next event estimation, multiple importance sampling", false},
    IntegratorInfo{"normal", shared::kIntegratorNormal, "shading normal, 0.5 + 0.5 n", true},
    IntegratorInfo{"albedo", shared::kIntegratorAlbedo, "base colour", true},
    IntegratorInfo{"depth", shared::kIntegratorDepth, "distance from the camera; PNG: divided by the scene's diagonal", true},
    IntegratorInfo{"uv", shared::kIntegratorUv, "texture coordinates, fractional part", true},
    IntegratorInfo{"primitive", shared::kIntegratorPrimitive, "a colour for each triangle", true},
    IntegratorInfo{"instance", shared::kIntegratorInstance, "a colour for each instance", true},
    IntegratorInfo{"barycentrics", shared::kIntegratorBarycentrics, "weights of the three vertices", true},
    IntegratorInfo{"direct", shared::kIntegratorDirect, "Cook-Torrance under all punctual lights with hard shadows, and a chain of mirror images; no noise", false},
    IntegratorInfo{"ao", shared::kIntegratorAo, "ambient occlusion: what of the hemisphere above the first hit is free", true},
    IntegratorInfo{"whitted", shared::kIntegratorWhitted, "Whitted's ray tracer: Phong under all punctual lights, mirrored and refracted rays; no noise", false},
};

}  // namespace

std::span<const IntegratorInfo> integratorTable() { return kIntegrators; }

const IntegratorInfo& findIntegrator(std::string_view name) {
    for (const IntegratorInfo& info : kIntegrators)
        if (info.name == name) return info;
    throw Error("there is no integrator '" + std::string(name) + "'");
}

std::vector<std::string> integratorNames() {
    std::vector<std::string> names;
    for (const IntegratorInfo& info : kIntegrators) names.emplace_back(info.name);
    return names;
}

}  // namespace raylab
