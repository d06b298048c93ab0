#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace raylab {

/// A row of the integrator table: `id` is what shaders/integrators/integrate.glsl dispatches on.
struct IntegratorInfo {
    std::string_view name;
    uint32_t id;
    std::string_view help;
    bool isView;  ///< shows the first hit; written without exposure and tonemap
};

std::span<const IntegratorInfo> integratorTable();

/// Throws Error where there is none of that name.
const IntegratorInfo& findIntegrator(std::string_view name);

std::vector<std::string> integratorNames();

}  // namespace raylab
