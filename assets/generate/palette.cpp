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

Material painted(Scene& scene, const Painting& painting, float roughness) {
    return texturedMaterial(scene, painting.name, painting.maps, roughness);
}

uint32_t addFoliage(Scene& scene, const Painting& painting) {
    Material material = painted(scene, painting, 0.55f);
    material.alphaMode = AlphaMode::mask;
    material.doubleSided = true;
    return addMaterial(scene, material);
}

/// Its base colour map is left out, since it is plain white.
uint32_t addWater(Scene& scene, const Painting& painting) {
    // Opaque: at the angles from which one sees it the pool is reflection over a dark body, and costs no caustic paths.
    Material material = plainMaterial(painting.name, {0.012f, 0.035f, 0.034f}, 0.02f);
    material.normalScale = 0.35f;
    material.normalTexture = addTexture(scene, "water normal", painting.maps.normal, false);
    return addMaterial(scene, material);
}

Material lanternGlow() {
    Material material = plainMaterial("lantern light", glm::vec3(0.8f), 1.0f);
    material.emission = {11.0f, 5.6f, 2.0f};
    return material;
}

}  // namespace

Palette addPalette(Scene& scene) {
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
    p.paving = addMaterial(scene, painted(scene, paintings[0], 1.0f));
    p.plaster = addMaterial(scene, painted(scene, paintings[1], 0.95f));
    p.limestone = addMaterial(scene, painted(scene, paintings[2], 0.85f));
    p.terracottaFloor = addMaterial(scene, painted(scene, paintings[3], 1.0f));
    p.roofTile = addMaterial(scene, painted(scene, paintings[4], 0.9f));
    p.wood = addMaterial(scene, painted(scene, paintings[5], 0.7f));
    p.marble = addMaterial(scene, painted(scene, paintings[6], 0.38f));
    p.water = addWater(scene, paintings[7]);
    p.citrusLeaf = addFoliage(scene, paintings[8]);
    p.bougainvillea = addFoliage(scene, paintings[9]);
    p.cypressLeaf = addFoliage(scene, paintings[10]);
    p.terracotta = addMaterial(scene, plainMaterial("terracotta", {0.52f, 0.215f, 0.115f}, 0.75f));
    p.earth = addMaterial(scene, plainMaterial("earth", {0.07f, 0.045f, 0.03f}, 1.0f));
    p.bark = addMaterial(scene, plainMaterial("bark", {0.16f, 0.115f, 0.08f}, 0.95f));
    p.orange = addMaterial(scene, plainMaterial("orange", {0.85f, 0.27f, 0.02f}, 0.45f));
    p.hills = addMaterial(scene, plainMaterial("hills", {0.17f, 0.175f, 0.075f}, 1.0f));
    p.gold = addMaterial(scene, plainMaterial("gold", {1.0f, 0.71f, 0.29f}, 0.16f, 1.0f));
    p.copper = addMaterial(scene, plainMaterial("copper", {0.95f, 0.64f, 0.54f}, 0.08f, 1.0f));
    p.iron = addMaterial(scene, plainMaterial("iron", {0.10f, 0.095f, 0.09f}, 0.55f, 1.0f));
    p.clearGlass = addMaterial(scene, glassMaterial("clear glass", {0.99f, 1.0f, 0.995f}));
    p.tintedGlass = addMaterial(scene, glassMaterial("blue glass", {0.50f, 0.76f, 0.94f}));
    p.lanternLight = addMaterial(scene, lanternGlow());
    return p;
}

}  // namespace raylab::assets
