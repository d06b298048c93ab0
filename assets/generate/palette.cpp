#include "assets/generate/palette.h"

#include <tbb/parallel_for.h>

#include <array>

#include "assets/generate/textures.h"

namespace raylab::assets {
namespace {

struct Painting {
    const char* name;
    SurfaceMaps (*paint)();
    SurfaceMaps maps = {};
};

/// A material with every map that the painting has; the base colour of `water` is left out, since it is plain white.
MaterialSpec painted(GltfWriter& gltf, const Painting& painting, float roughness) {
    MaterialSpec spec{.name = painting.name};
    const std::string name = painting.name;
    spec.roughness = roughness;
    spec.baseColorTexture = gltf.addTexture(name + " colour", painting.maps.baseColor);
    if (!painting.maps.normal.empty()) spec.normalTexture = gltf.addTexture(name + " normal", painting.maps.normal);
    if (!painting.maps.metallicRoughness.empty()) {
        spec.metallicRoughnessTexture = gltf.addTexture(name + " roughness", painting.maps.metallicRoughness);
    }
    return spec;
}

uint32_t addFoliage(GltfWriter& gltf, const Painting& painting) {
    MaterialSpec spec = painted(gltf, painting, 0.55f);
    spec.alphaCutoff = 0.5f;
    spec.doubleSided = true;
    return gltf.addMaterial(spec);
}

uint32_t addPlain(GltfWriter& gltf, const char* name, glm::vec3 baseColor, float roughness, float metallic = 0.0f) {
    MaterialSpec spec{.name = name, .baseColor = baseColor};
    spec.roughness = roughness;
    spec.metallic = metallic;
    return gltf.addMaterial(spec);
}

/// `tint` is what one passage through the surface leaves of white light.
uint32_t addGlass(GltfWriter& gltf, const char* name, glm::vec3 tint) {
    MaterialSpec spec{.name = name, .baseColor = tint};
    spec.roughness = 0.0f;
    spec.transmission = 1.0f;
    spec.thickness = 0.1f;
    return gltf.addMaterial(spec);
}

uint32_t addWater(GltfWriter& gltf, const Painting& painting) {
    // Opaque: at the angles from which one sees it the pool is reflection over a dark body, and costs no caustic paths.
    MaterialSpec spec{.name = painting.name, .baseColor = glm::vec3(0.012f, 0.035f, 0.034f)};
    spec.roughness = 0.02f;
    spec.normalScale = 0.35f;
    spec.normalTexture = gltf.addTexture("water normal", painting.maps.normal);
    return gltf.addMaterial(spec);
}

uint32_t addLight(GltfWriter& gltf) {
    MaterialSpec spec{.name = "lantern light", .baseColor = glm::vec3(0.8f)};
    spec.emission = glm::vec3(11.0f, 5.6f, 2.0f);
    return gltf.addMaterial(spec);
}

}  // namespace

Palette addPalette(GltfWriter& gltf) {
    std::array<Painting, 11> paintings = {{{"paving", paintPaving},
                                           {"plaster", paintPlaster},
                                           {"limestone", paintLimestone},
                                           {"terracotta floor", paintTerracottaFloor},
                                           {"roof tile", paintRoofTile},
                                           {"wood", paintWood},
                                           {"marble", paintMarble},
                                           {"water", paintWater},
                                           {"citrus leaf", paintCitrusSprig},
                                           {"bougainvillea", paintBougainvilleaSprig},
                                           {"cypress leaf", paintCypressSprig}}};
    tbb::parallel_for(size_t{0}, paintings.size(), [&](size_t i) { paintings[i].maps = paintings[i].paint(); });

    Palette p;
    p.paving = gltf.addMaterial(painted(gltf, paintings[0], 1.0f));
    p.plaster = gltf.addMaterial(painted(gltf, paintings[1], 0.95f));
    p.limestone = gltf.addMaterial(painted(gltf, paintings[2], 0.85f));
    p.terracottaFloor = gltf.addMaterial(painted(gltf, paintings[3], 1.0f));
    p.roofTile = gltf.addMaterial(painted(gltf, paintings[4], 0.9f));
    p.wood = gltf.addMaterial(painted(gltf, paintings[5], 0.7f));
    p.marble = gltf.addMaterial(painted(gltf, paintings[6], 0.38f));
    p.water = addWater(gltf, paintings[7]);
    p.citrusLeaf = addFoliage(gltf, paintings[8]);
    p.bougainvillea = addFoliage(gltf, paintings[9]);
    p.cypressLeaf = addFoliage(gltf, paintings[10]);
    p.terracotta = addPlain(gltf, "terracotta", {0.52f, 0.215f, 0.115f}, 0.75f);
    p.earth = addPlain(gltf, "earth", {0.07f, 0.045f, 0.03f}, 1.0f);
    p.bark = addPlain(gltf, "bark", {0.16f, 0.115f, 0.08f}, 0.95f);
    p.orange = addPlain(gltf, "orange", {0.85f, 0.27f, 0.02f}, 0.45f);
    p.hills = addPlain(gltf, "hills", {0.17f, 0.175f, 0.075f}, 1.0f);
    p.gold = addPlain(gltf, "gold", {1.0f, 0.71f, 0.29f}, 0.16f, 1.0f);
    p.copper = addPlain(gltf, "copper", {0.95f, 0.64f, 0.54f}, 0.08f, 1.0f);
    p.iron = addPlain(gltf, "iron", {0.10f, 0.095f, 0.09f}, 0.55f, 1.0f);
    p.clearGlass = addGlass(gltf, "clear glass", {0.99f, 1.0f, 0.995f});
    p.tintedGlass = addGlass(gltf, "blue glass", {0.50f, 0.76f, 0.94f});
    p.lanternLight = addLight(gltf);
    return p;
}

}  // namespace raylab::assets
