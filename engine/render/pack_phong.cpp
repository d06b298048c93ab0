#include <algorithm>

#include "engine/render/gpu_data.h"

namespace raylab {
namespace {

static_assert(kOpaqueIor == shared::kOpaqueIor);

glm::vec3 unit(glm::vec3 color) { return glm::clamp(color, glm::vec3(0.0f), glm::vec3(1.0f)); }

/// Within the bounds that PhongMaterial promises, for the kernel's stack relies on them: what a surface mirrors and
/// lets through is no more than what arrives.
shared::PhongData packPhongMaterial(const PhongMaterial& phong) {
    shared::PhongData data{};
    data.diffuse = unit(phong.diffuse);
    data.exponent = std::clamp(phong.exponent, 1.0f, shared::kLargestExponent);
    data.specular = unit(phong.specular);
    data.reflection = std::clamp(phong.reflection, 0.0f, 1.0f);
    data.mirror = unit(phong.mirror);
    data.ior = std::max(phong.ior, 1.0f);
    data.tint = unit(phong.tint);
    data.isGiven = 1;
    return data;
}

}  // namespace

std::vector<shared::PhongData> packPhong(const Scene& scene) {
    std::vector<shared::PhongData> packed;
    for (const Material& material : scene.materials)
        packed.push_back(material.phong ? packPhongMaterial(*material.phong) : shared::PhongData{});
    return packed;
}

}  // namespace raylab
