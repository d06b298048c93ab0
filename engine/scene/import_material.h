#pragma once

#include <filesystem>

#include "engine/scene/import_texture.h"
#include "engine/scene/scene.h"

struct aiScene;

namespace raylab {

/// Materials of the formats with Phong-style materials (OBJ with MTL above all), one for one in Assimp's order:
///
/// - Kd, map_Kd: base colour. Ks: `specular`, its largest component; 0 where Ks is black, so Kd alone is Lambertian.
/// - Ns: the GGX lobe of a Phong exponent, alpha = sqrt(2 / (Ns + 2)) (Walter et al. 2007, section 5.2). Pr, Pm
/// override.
/// - Ke, map_Ke: emission. d, Tr: alpha, blended. map_d: alpha mask.
/// - illum 4, 6, 7, 9, or Tf with d < 1: glass of colour Tf; illum 3, 5 with Ks: a mirror of colour Ks.
/// - All of it literally as the material's PhongMaterial, unless Pr or Pm is there: Kd, Ks, Ns; mirrors reflect Ks; glass is
/// tinted by Tf at each surface and keeps of Kd what Tf leaves.
/// - Ni: index of refraction, 1.5 where it is missing or 1. norm, or map_Bump that is not grey: normal map.
///
/// Without any material: defaultMaterial(). Appends to scene.materials, scene.warnings and `requests`.
void readPhongMaterials(const aiScene& source, const std::filesystem::path& path, TextureRequests& requests,
                        Scene& scene);

/// What a surface without any material looks like: a grey Lambertian of reflectance 0.8.
Material defaultMaterial();

}  // namespace raylab
