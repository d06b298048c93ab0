#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "engine/scene/import_mesh.h"
#include "tests/support/scene_build.h"
#include "tests/unit/save_support.h"
#include "ui/editor/model/document_file.h"
#include "ui/editor/model/edit_lights.h"
#include "ui/editor/model/shapes.h"

/// Scenes and comparisons for the tests of the editor's document.
namespace raylab::editortest {

using namespace raylab::editor;
using importtest::ScratchFolder;

inline Texture smallTexture(const std::string& name, bool srgb) {
    return {.name = name,
            .width = 2,
            .height = 2,
            .texels = {0xFF102030u, 0xFF405060u, 0xFF708090u, 0xFFA0B0C0u},
            .srgb = srgb};
}

/// Two boxes, two instances of a quad, a quadric; four materials, three textures, lights of all kinds, a camera, a sky.
/// Everything is used and in the importer's order, so that saving keeps it bit for bit.
inline Scene smallScene() {
    Scene scene;
    scene.name = "small";
    for (const char* name : {"paint", "rough", "bumps"})
        scene.textures.push_back(smallTexture(name, scene.textures.empty()));
    for (const char* name : {"red", "lamp", "glass", "metal"}) scene.materials.push_back({.name = name});
    scene.materials[0].baseColorTexture = 0;
    scene.materials[0].metallicRoughnessTexture = 1;
    scene.materials[0].normalTexture = 2;
    scene.materials[1].emission = glm::vec3(3.0f, 2.0f, 1.0f);
    scene.materials[2].transmission = 1.0f;
    scene.materials[2].thin = false;
    scene.materials[3].metallic = 1.0f;
    const auto named = [](Mesh mesh, const char* name) {
        mesh.name = name;
        return mesh;
    };
    scene.meshes.push_back(named(makeShape(Shape::sphere), "ball"));
    scene.meshes.push_back(named(support::box(1, glm::vec3(-1), glm::vec3(1)), "box"));
    scene.meshes.push_back(named(support::floorQuad(2, 4.0f), "floor"));
    scene.meshes.push_back({.name = "cone", .material = 3, .quadrics = makeShape(Shape::cone).quadrics});
    ensureTangents(scene.meshes[0]);
    uint32_t number = 0;
    for (const uint32_t mesh : {0u, 1u, 2u, 2u, 3u}) {
        const glm::vec3 at(static_cast<float>(number) * 3.0f, 0.25f, -1.0f);
        scene.instances.push_back({"thing " + std::to_string(number++), mesh, glm::translate(glm::mat4(1.0f), at)});
    }
    scene.cameras.push_back({.name = "front"});
    for (const LightKind kind : {LightKind::point, LightKind::directional, LightKind::spot})
        scene.lights.push_back({.name = std::string("light ") + lightKindName(kind), .kind = kind});
    scene.sky = SkyDescription{};
    return scene;
}

/// A state as it would be after saving and reading: what undo has to bring back.
struct Snapshot {
    Scene scene;
    std::vector<uint8_t> hidden;
    std::vector<std::string> settings;
};

inline Snapshot snapshotOf(const Document& document) {
    Snapshot snapshot{document.scene(), document.hidden(), {}};
    for (const auto& setting : renderSettingsTable())
        snapshot.settings.push_back(settingText(getSetting(setting, document.settings())));
    return snapshot;
}

inline void expectSame(const Snapshot& a, const Snapshot& b) {
    importtest::expectSameScene(a.scene, b.scene);
    EXPECT_EQ(a.hidden, b.hidden);
    EXPECT_EQ(a.settings, b.settings);
}

}  // namespace raylab::editortest
