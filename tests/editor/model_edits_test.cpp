#include <algorithm>

#include "engine/scene/bounds.h"
#include "engine/scene/f0_presets.h"
#include "engine/scene/import.h"
#include "engine/scene/needs.h"
#include "engine/scene/quadric.h"
#include "engine/scene/save_gltf.h"
#include "engine/scene/texture_slots.h"
#include "model_support.h"
#include "ui/editor/model/edit_cameras.h"
#include "ui/editor/model/edit_instances.h"
#include "ui/editor/model/edit_materials.h"
#include "ui/editor/model/edit_surroundings.h"
#include "ui/editor/model/merge_scene.h"
#include "ui/editor/model/transform_parts.h"

namespace raylab::editortest {
namespace {

namespace fs = std::filesystem;

/// A material with a number of its own in every field.
Material fullMaterial(const Material& textures) {
    Material m = textures;
    m.baseColor = {0.1f, 0.2f, 0.3f};
    m.alpha = 0.4f;
    m.metallic = 0.5f;
    m.roughness = 0.6f;
    if (m.normalTexture != kNoTexture) m.normalScale = 0.7f;
    m.emission = {8.0f, 9.0f, 10.0f};
    m.alphaMode = AlphaMode::blend;
    m.alphaCutoff = 0.11f;
    m.transmission = 0.12f;
    m.ior = 1.3f;
    m.thin = false;
    m.specular = 0.14f;
    m.doubleSided = true;
    m.specularColor = {0.21f, 0.22f, 0.23f};
    m.clearcoat = 0.24f;
    m.clearcoatRoughness = 0.25f;
    m.sheenColor = {0.26f, 0.27f, 0.28f};
    m.sheenRoughness = 0.29f;
    m.anisotropy = 0.31f;
    m.anisotropyRotationRadians = 0.32f;
    m.attenuationColor = {0.33f, 0.34f, 0.35f};
    m.attenuationDistance = 36.0f;
    m.thickness = 0.37f;
    m.priority = 38;
    m.phong = PhongMaterial{glm::vec3(0.15f), glm::vec3(0.16f), 17.0f, glm::vec3(0.18f), glm::vec3(0.19f), 0.2f, 2.1f};
    return m;
}

struct NamedEdit {
    const char* name;
    std::function<Edit(const Scene&)> make;
};

/// Each kind of edit of what a scene file holds.
const std::vector<NamedEdit> kEdits = {
    {"place",
     [](const Scene&) {
         return placeInstances({{1, glm::scale(glm::mat4(1.0f), {0.3f, -2.0f, 1.7f})}}, "Scale");
     }},
    {"rename", [](const Scene&) { return renameInstance(2, "Tür \"2\""); }},
    {"duplicate",
     [](const Scene&) {
         return duplicateInstances({0, 4});
     }},
    {"delete", [](const Scene&) { return deleteInstances({3}); }},
    {"assign to all that show the mesh",
     [](const Scene&) {
         return assignMaterial({2, 3}, 0);
     }},
    {"material", [](const Scene& s) { return setMaterial(0, fullMaterial(s.materials[0]), "all"); }},
    {"preset", [](const Scene&) { return applyPreset(3, "copper"); }},
    {"no texture", [](const Scene&) { return setTexture(0, TextureSlot::metallicRoughness, kNoTexture); }},
    {"paste", [](const Scene& s) { return pasteMaterial(2, materialText(fullMaterial(s.materials[0]), s)); }},
    {"point light",
     [](const Scene&) {
         return addLight({.name = "l", .intensity = {0.1f, 200.0f, 3.0f}});
     }},
    {"directional light",
     [](const Scene&) {
         return addLight({.name = "sun", .kind = LightKind::directional, .direction = {1, -2, 3}});
     }},
    {"light",
     [](const Scene&) {
         return setLight(2,
                         {.name = "s",
                          .kind = LightKind::spot,
                          .position = {1, 2, 3},
                          .innerConeRadians = 0.2f,
                          .outerConeRadians = 0.6f},
                         "all");
     }},
    {"duplicate light", [](const Scene&) { return duplicateLight(1); }},
    {"delete light", [](const Scene&) { return deleteLight(1); }},
    {"add camera",
     [](const Scene&) {
         return addCamera({.name = "new", .position = {3, 2, 1}, .target = {0, 1, 0.3f}});
     }},
    {"camera", [](const Scene& s) { return setCamera(0, atRadius(s.cameras[0], 2.5f), "radius"); }},
    {"delete camera", [](const Scene&) { return deleteCamera(0); }},
    {"sky", [](const Scene&) { return setSky({.sunElevationRadians = 0.25f, .turbidity = 4.0f}); }},
    {"no surroundings", [](const Scene&) { return removeSurroundings(); }},
    {"plane",
     [](const Scene&) {
         return addShape(Shape::plane, {1, 2, 3}, 0.5f);
     }},
    {"box",
     [](const Scene&) {
         return addShape(Shape::box, {1, 2, 3}, 0.5f);
     }},
    {"sphere",
     [](const Scene&) {
         return addShape(Shape::sphere, {1, 2, 3}, 0.5f);
     }},
    {"ellipsoid",
     [](const Scene&) {
         return addShape(Shape::ellipsoid, {1, 2, 3}, 0.5f);
     }},
    {"cylinder",
     [](const Scene&) {
         return addShape(Shape::cylinder, {1, 2, 3}, 0.5f);
     }},
    {"cone",
     [](const Scene&) {
         return addShape(Shape::cone, {1, 2, 3}, 0.5f);
     }},
    {"hyperboloid",
     [](const Scene&) {
         return addShape(Shape::hyperboloid, {1, 2, 3}, 0.5f);
     }},
    {"paraboloid",
     [](const Scene&) {
         return addShape(Shape::paraboloid, {1, 2, 3}, 0.5f);
     }},
};

/// Triangles before quadrics: what the importer makes of an order.
void sortMeshes(Scene& scene) {
    std::vector<uint32_t> order;
    for (const bool quadrics : {false, true})
        for (uint32_t m = 0; m < scene.meshes.size(); ++m)
            if (scene.meshes[m].quadrics.empty() != quadrics) order.push_back(m);
    SharedList<Mesh> sorted;
    std::vector<uint32_t> newIndex(order.size());
    for (const uint32_t m : order) {
        newIndex[m] = static_cast<uint32_t>(sorted.size());
        sorted.push_back(scene.meshes[m]);
    }
    for (Instance& instance : scene.instances) instance.mesh = newIndex[instance.mesh];
    scene.meshes = sorted;
}

void dropUnwornMaterials(Scene& scene) {
    std::vector<uint32_t> newIndex;
    std::vector<Material> kept;
    for (uint32_t m = 0; m < scene.materials.size(); ++m) {
        const bool isWorn =
            std::ranges::any_of(std::as_const(scene.meshes), [m](const Mesh& mesh) { return mesh.material == m; });
        newIndex.push_back(static_cast<uint32_t>(kept.size()));
        if (isWorn) kept.push_back(scene.materials[m]);
    }
    for (Mesh& mesh : scene.meshes) mesh.material = newIndex[mesh.material];
    scene.materials = kept;
}

TEST(EditorEdits, EveryKindComesBackFromAFile) {
    const ScratchFolder folder;
    const fs::path file = folder.path() / "small.glb";
    for (const NamedEdit& each : kEdits) {
        SCOPED_TRACE(each.name);
        Document document(smallScene());
        ASSERT_TRUE(document.apply(each.make(document.scene())));
        saveGltf(document.scene(), file);
        Scene wanted = document.scene();
        sortMeshes(wanted);
        dropUnwornMaterials(wanted);
        wanted.name = "small";
        // What no longer has a use is not imported: the texture, or the tangents, that the edit made superfluous.
        if (std::string(each.name) == "no texture") {
            wanted.materials[0].normalTexture = 1;
            wanted.textures.shared().erase(wanted.textures.shared().begin() + 1);
        }
        importtest::expectSameScene(importScene(file), wanted);
    }
}

TEST(EditorEdits, AMaterialThatOnlySomeInstancesGetIsOnACopyOfTheMesh) {
    Document document(smallScene());
    const size_t meshes = document.scene().meshes.size();
    document.apply(assignMaterial({2}, 0));  // mesh 2 is shown by instances 2 and 3
    const Scene& scene = document.scene();
    ASSERT_EQ(scene.meshes.size(), meshes + 1);
    EXPECT_EQ(scene.meshes[scene.instances[2].mesh].material, 0u);
    EXPECT_EQ(scene.meshes[scene.instances[3].mesh].material, 2u);
    EXPECT_EQ(scene.meshes[scene.instances[2].mesh].positions, scene.meshes[scene.instances[3].mesh].positions);
}

TEST(EditorEdits, DeletingAMaterialMovesTheOthersIndices) {
    Document document(smallScene());
    document.apply(assignMaterial({1}, 0));  // nobody wears the lamp any more
    document.apply(deleteMaterial(1));
    const Scene& scene = document.scene();
    ASSERT_EQ(scene.materials.size(), 3u);
    for (const auto& [instance, name] :
         std::map<uint32_t, std::string>{{0, "red"}, {1, "red"}, {2, "glass"}, {4, "metal"}})
        EXPECT_EQ(scene.materials[scene.meshes[scene.instances[instance].mesh].material].name, name);
}

TEST(EditorEdits, MaterialsAreTakenIntoTheirRanges) {
    Document document(smallScene());
    Material wild = document.scene().materials[3];
    wild.roughness = 7.0f;
    wild.ior = -1.0f;
    wild.emission = glm::vec3(std::numeric_limits<float>::quiet_NaN(), -3.0f, 2.0f);
    document.apply(setMaterial(3, wild, "all"));
    const Material& tame = document.scene().materials[3];
    EXPECT_EQ(tame.roughness, 1.0f);
    EXPECT_EQ(tame.ior, 1.0f);
    EXPECT_EQ(tame.emission, glm::vec3(0.0f, 0.0f, 2.0f));
}

TEST(EditorEdits, PresetsGiveTheTablesReflectance) {
    for (const F0Preset& preset : f0Presets()) {
        Document document(smallScene());
        Material before = document.scene().materials[0];
        before.roughness = 0.3f;
        document.apply(setMaterial(0, before, "roughness"));
        document.apply(applyPreset(0, std::string(preset.name)));
        const Material& m = document.scene().materials[0];
        const float dielectric = (m.ior - 1.0f) / (m.ior + 1.0f);
        const glm::vec3 f0 = m.metallic > 0.0f ? m.baseColor : glm::vec3(dielectric * dielectric);
        importtest::expectNear(f0, preset.f0, 1e-5f);
        EXPECT_EQ(m.roughness, 0.3f) << preset.name;
        EXPECT_EQ(m.baseColorTexture, before.baseColorTexture) << preset.name;
    }
    EXPECT_THROW(applyPreset(0, "unobtainium"), Error);
}

TEST(EditorEdits, ACopiedMaterialIsPastedWithoutItsName) {
    Document document(smallScene());
    const Material full = fullMaterial(document.scene().materials[0]);
    document.apply(pasteMaterial(2, materialText(full, document.scene())));
    Material wanted = full;
    wanted.name = "glass";
    EXPECT_EQ(document.scene().materials[2], wanted);
    Document elsewhere(Scene{.materials = {Material{.name = "bare"}}});
    elsewhere.apply(pasteMaterial(0, materialText(full, document.scene())));
    EXPECT_EQ(elsewhere.scene().materials[0].baseColorTexture, kNoTexture);  // it has no such textures
    EXPECT_EQ(elsewhere.scene().materials[0].ior, full.ior);
    Material clear = document.scene().materials[0];
    clear.lobeTextures.sheenColor = 0;  // a colour
    document.apply(pasteMaterial(2, materialText(clear, document.scene())));
    clear.name = "glass";
    EXPECT_EQ(document.scene().materials[2], clear) << "an infinite distance, a lobe's texture";
    for (const char* text : {"", "hello", "{}", "{\"schema\": \"raylab.camera/1\"}"})
        EXPECT_THROW(pasteMaterial(0, text), Error) << text;
}

TEST(EditorEdits, ATextureInTheOtherSortOfSlotIsACopy) {
    Document document(smallScene());
    document.apply(setTexture(3, TextureSlot::normal, 0));  // 0 is a colour
    const Scene& scene = document.scene();
    ASSERT_EQ(scene.textures.size(), 4u);
    EXPECT_EQ(scene.materials[3].normalTexture, 3);
    EXPECT_FALSE(scene.textures[3].srgb);
    EXPECT_TRUE(scene.textures[0].srgb);
    EXPECT_EQ(scene.textures[3].texels, scene.textures[0].texels);
}

TEST(EditorEdits, ANormalMapBringsTangents) {
    Document document(smallScene());
    ASSERT_TRUE(document.scene().meshes[2].tangents.empty());
    document.apply(setTexture(2, TextureSlot::normal, 2));
    EXPECT_EQ(document.scene().meshes[2].tangents.size(), document.scene().meshes[2].positions.size());
}

TEST(EditorEdits, ShapesAreTwoAcrossAndFaceOutwards) {
    for (const Shape shape : kShapes) {
        SCOPED_TRACE(shapeName(shape));
        Scene scene;
        scene.materials.push_back({});
        scene.meshes.push_back(makeShape(shape));
        scene.instances.push_back({});
        const Bounds bounds = sceneBounds(scene);
        EXPECT_NEAR(bounds.hi.x - bounds.lo.x, 2.0f, 1e-4f);
        const Mesh& mesh = std::as_const(scene.meshes)[0];
        if (shape == Shape::plane || mesh.triangles.empty()) continue;
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
            ASSERT_GT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0.0f);
        }
    }
    const Mesh sphere = makeShape(Shape::sphere);
    double volume = 0.0;  // by the divergence theorem; a closed mesh alone has it right
    for (const glm::uvec3& t : sphere.triangles)
        volume += glm::dot(glm::dvec3(sphere.positions[t.x]),
                           glm::cross(glm::dvec3(sphere.positions[t.y]), glm::dvec3(sphere.positions[t.z]))) /
                  6.0;
    EXPECT_NEAR(volume, 4.18879, 0.02);
}

TEST(EditorEdits, AnAddedShapeStandsWhereItIsAskedFor) {
    for (const Shape shape : kShapes) {
        SCOPED_TRACE(shapeName(shape));
        Document document(smallScene());
        document.apply(addShape(shape, {10, 20, 30}, 0.5f));
        ASSERT_EQ(document.selection().instances.size(), 1u);
        Scene alone = document.scene();
        alone.instances = {document.scene().instances[document.selection().instances[0]]};
        const Bounds bounds = sceneBounds(alone);
        EXPECT_NEAR(bounds.lo.x, 9.5f, 1e-3f);
        EXPECT_NEAR(bounds.hi.x, 10.5f, 1e-3f);
        EXPECT_NEAR(bounds.hi.z, 30.5f, 1e-3f);
        EXPECT_GE(bounds.lo.y, 19.5f - 1e-3f);
        EXPECT_LE(bounds.hi.y, 20.5f + 1e-3f);
    }
}

TEST(EditorEdits, MergedScenesPointIntoThemselves) {
    Scene other = smallScene();
    other.materials[0].lobeTextures.sheenColor = 2;
    other.instances[0].endToWorld = glm::translate(glm::mat4(1.0f), glm::vec3(1.0f, 0.0f, 0.0f));
    Document document(smallScene());
    const glm::mat4 placement = glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 50.0f, 0.0f));
    document.apply(mergeScene(other, placement));
    const Scene& scene = document.scene();
    ASSERT_EQ(scene.instances.size(), 10u);
    EXPECT_EQ(document.hidden().size(), 10u);
    EXPECT_EQ(document.selection().instances, (std::vector<uint32_t>{5, 6, 7, 8, 9}));
    for (size_t i = 0; i < 5; ++i) {
        const Instance &mine = other.instances[i], &merged = scene.instances[5 + i];
        const Mesh &a = other.meshes[mine.mesh], &b = scene.meshes[merged.mesh];
        EXPECT_EQ(a.positions, b.positions);
        EXPECT_EQ(merged.objectToWorld, placement * mine.objectToWorld);
        const Material &ma = other.materials[a.material], &mb = scene.materials[b.material];
        EXPECT_EQ(ma.name, mb.name);
        const auto before = textureSlots(ma), after = textureSlots(mb);
        for (size_t slot = 0; slot < before.size(); ++slot) {
            ASSERT_EQ(*before[slot] == kNoTexture, *after[slot] == kNoTexture);
            if (*before[slot] == kNoTexture) continue;
            EXPECT_EQ(*after[slot], *before[slot] + 3);
            EXPECT_EQ(scene.textures[static_cast<size_t>(*after[slot])].name,
                      other.textures[static_cast<size_t>(*before[slot])].name);
        }
    }
    EXPECT_EQ(scene.instances[5].endToWorld, placement * *other.instances[0].endToWorld);
    EXPECT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[1].position, other.cameras[0].position + glm::vec3(0.0f, 50.0f, 0.0f));
    EXPECT_EQ(scene.lights.size(), 6u);
}

TEST(EditorEdits, CamerasMoveAlongTheirView) {
    const Camera camera{.position = {0, 3, 4}, .target = {0, 0, 0}};
    EXPECT_FLOAT_EQ(cameraRadius(camera), 5.0f);
    importtest::expectNear(movedAlongView(camera, 2.5f, 2).position, {0, 6, 8});
    importtest::expectNear(movedAlongView(camera, 2.5f, -1).position, {0, 1.5f, 2});
    EXPECT_GT(cameraRadius(movedAlongView(camera, 1.0f, -99)), 0.0f);  // short of the target
    const Camera copy = parseCamera(cameraText(camera));
    EXPECT_EQ(copy, camera);
    EXPECT_THROW(parseCamera("{}"), Error);
    Document document(smallScene());
    EXPECT_THROW(document.apply(addCamera({.position = {1, 1, 1}, .target = {1, 1, 1}})), Error);
    EXPECT_THROW(document.apply(setCamera(0, {.fovYRadians = 4.0f}, "field of view")), Error);
}

TEST(EditorEdits, TransformPartsComeBack) {
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        TransformParts parts;
        for (int c = 0; c < 3; ++c) {
            parts.translation[c] = 10.0 * unit(engine);
            parts.rotationDegrees[c] = (c == 1 ? 89.0 : 179.0) * unit(engine);
            parts.scale[c] = 2.0 + unit(engine);
        }
        if (i % 2 == 0) parts.scale.x = -parts.scale.x;
        const auto back = partsOf(matrixOf(parts));
        ASSERT_TRUE(back);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(back->translation[c], parts.translation[c], 1e-5);
            EXPECT_NEAR(back->rotationDegrees[c], parts.rotationDegrees[c], 2e-3);
            EXPECT_NEAR(back->scale[c], parts.scale[c], 1e-5);
        }
    }
    const glm::mat4 quarterTurn = matrixOf({.rotationDegrees = {0, 0, 90}});
    importtest::expectNear(glm::vec3(quarterTurn[0]), {0, 1, 0});
    const auto up = partsOf(matrixOf({.rotationDegrees = {20, 90, 30}}));  // gimbal lock: other angles, the same matrix
    ASSERT_TRUE(up);
    const glm::mat4 same = matrixOf(*up), wanted = matrixOf({.rotationDegrees = {20, 90, 30}});
    for (int c = 0; c < 3; ++c) importtest::expectNear(glm::vec3(same[c]), glm::vec3(wanted[c]), 1e-5f);
    glm::mat4 sheared(1.0f);
    sheared[1][0] = 0.5f;
    EXPECT_FALSE(partsOf(sheared));
}

}  // namespace
}  // namespace raylab::editortest
