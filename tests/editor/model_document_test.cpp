#include "model_support.h"
#include "ui/editor/model/edit_cameras.h"
#include "ui/editor/model/edit_instances.h"
#include "ui/editor/model/edit_kinds.h"
#include "ui/editor/model/edit_materials.h"
#include "ui/editor/model/edit_surroundings.h"
#include "ui/editor/model/merge_scene.h"

namespace raylab::editortest {
namespace {

constexpr uint32_t kSeed = 20261122;

/// Edits of every kind with random arguments that fit the document.
class RandomEdits {
public:
    explicit RandomEdits(uint32_t seed) : engine_(seed) {}

    Edit next(const Document& document) {
        const Scene& scene = document.scene();
        switch (below(20)) {
            case 0:
                return placeInstances({{any(scene.instances), affine()}}, "Move", below(2) == 0 ? "drag" : "");
            case 1:
                return renameInstance(any(scene.instances), "name " + std::to_string(below(100)));
            case 2:
                return duplicateInstances({any(scene.instances), any(scene.instances)});
            case 3:
                return scene.instances.size() > 3 ? deleteInstances({any(scene.instances)}) : showAllInstances();
            case 4:
                return showInstances({any(scene.instances)}, below(2) == 0);
            case 5:
                return isolateInstances({any(scene.instances), any(scene.instances)});
            case 6:
                return assignMaterial({any(scene.instances), any(scene.instances)}, any(scene.materials));
            case 7:
            case 8:
                return setMaterial(any(scene.materials), material(), "all", below(2) == 0 ? "slider" : "");
            case 9:
                return addMaterial(material());
            case 10:
                return applyPreset(any(scene.materials), "gold");
            case 11:
                return setTexture(any(scene.materials), kTextureSlots[below(4)],
                                  static_cast<int32_t>(any(scene.textures)));
            case 12:
                return addShape(kShapes[below(kShapes.size())], vec(), number() + 0.1f);
            case 13:
                return scene.lights.size() < 3 ? addLight(light()) : setLight(any(scene.lights), light(), "all");
            case 14:
                return scene.lights.size() > 2 ? deleteLight(any(scene.lights)) : addLight(light());
            case 15:
                return addCamera({.name = "view", .position = vec() + glm::vec3(9.0f), .target = vec()});
            case 16:
                return setSky({.turbidity = 1.0f + number()});
            case 17:
                return setRenderSetting("depth", std::to_string(below(50)));
            case 18:
                return scene.meshes.size() < 60 ? mergeScene(smallScene(), affine()) : removeSurroundings();
            default:
                return setRenderSetting("exposure", std::to_string(below(8)), "exposure");
        }
    }

    uint32_t below(size_t count) { return static_cast<uint32_t>(engine_() % count); }

private:
    template <class List>
    uint32_t any(const List& list) {
        return below(list.size());
    }
    float number() { return std::uniform_real_distribution<float>(0.0f, 1.0f)(engine_); }
    glm::vec3 vec() { return {number() - 0.5f, number() - 0.5f, number() - 0.5f}; }
    glm::mat4 affine() {
        glm::mat4 m = glm::translate(glm::mat4(1.0f), 10.0f * vec());
        m = glm::rotate(m, 6.0f * number(), glm::normalize(vec() + glm::vec3(0.0f, 2.0f, 0.0f)));
        return glm::scale(m, vec() + glm::vec3(1.0f));
    }
    Material material() {
        Material m{.name = "random " + std::to_string(below(10)), .baseColor = vec() + glm::vec3(0.5f)};
        m.roughness = number();
        m.metallic = number();
        m.emission = below(4) == 0 ? vec() + glm::vec3(1.0f) : glm::vec3(0.0f);
        if (below(3) == 0) m.phong = PhongMaterial{.mirror = vec() + glm::vec3(0.5f)};
        return m;
    }
    Light light() {
        return {.kind = static_cast<LightKind>(below(3)), .position = vec(), .direction = vec(), .intensity = vec()};
    }

    std::mt19937 engine_;
};

TEST(EditorDocument, AThousandEditsAndUndosGiveBackTheSceneBitByBit) {
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    Document document(smallScene());
    RandomEdits edits(kSeed);
    std::vector<Snapshot> states = {snapshotOf(document)};  // by the number of steps
    for (int i = 0; i < 1000; ++i) {
        document.apply(edits.next(document));
        states.resize(document.undoSteps());
        states.push_back(snapshotOf(document));
        if (edits.below(3) == 0) document.endMerge();
    }
    ASSERT_GT(states.size(), 600u);  // some edits change nothing, some are merged
    const size_t last = states.size() - 1;
    for (size_t i = last; i-- > 0;) {
        ASSERT_TRUE(document.undo());
        if (i % 50 == 0 || i > last - 5) expectSame(snapshotOf(document), states[i]);
    }
    EXPECT_FALSE(document.undo());
    EXPECT_FALSE(document.isUnsaved());
    for (size_t i = 1; i <= last; ++i) {
        ASSERT_TRUE(document.redo());
        if (i % 50 == 0 || i == last) expectSame(snapshotOf(document), states[i]);
    }
    EXPECT_FALSE(document.redo());
}

TEST(EditorDocument, UndoAndRedoAnyWhichWay) {
    Document document(smallScene());
    RandomEdits edits(kSeed + 1);
    std::vector<Snapshot> states = {snapshotOf(document)};
    for (int i = 0; i < 400; ++i) {
        const uint32_t die = edits.below(4);
        if (die == 0) document.undo();
        if (die == 1) document.redo();
        if (die >= 2) {
            document.endMerge();
            if (document.apply(edits.next(document))) {
                states.resize(document.undoSteps());
                states.push_back(snapshotOf(document));
                EXPECT_EQ(document.redoSteps(), 0u);
            }
        }
        if (i % 20 == 0) expectSame(snapshotOf(document), states[document.undoSteps()]);
    }
}

TEST(EditorDocument, ADragIsOneStepAndItsUndoGoesToItsBeginning) {
    Document document(smallScene());
    const Snapshot before = snapshotOf(document);
    Material material = document.scene().materials[1];
    for (int i = 1; i <= 100; ++i) {
        material.roughness = 1.0f - 0.01f * static_cast<float>(i);
        EXPECT_TRUE(document.apply(setMaterial(1, material, "roughness", "roughness 1")));
    }
    EXPECT_EQ(document.undoSteps(), 1u);
    EXPECT_EQ(document.undoName(), "Change roughness of lamp");
    document.endMerge();
    material.roughness = 0.5f;
    document.apply(setMaterial(1, material, "roughness", "roughness 1"));
    EXPECT_EQ(document.undoSteps(), 2u);
    document.undo();
    document.undo();
    expectSame(snapshotOf(document), before);
    EXPECT_EQ(document.redoName(), "Change roughness of lamp");
}

TEST(EditorDocument, ADragBackToItsBeginningIsNoStep) {
    Document document(smallScene());
    Material material = document.scene().materials[1];
    const float roughness = material.roughness;
    for (const float value : {0.3f, 0.6f, roughness}) {
        material.roughness = value;
        document.apply(setMaterial(1, material, "roughness", "drag"));
    }
    EXPECT_EQ(document.undoSteps(), 0u);
    EXPECT_FALSE(document.isUnsaved());
}

TEST(EditorDocument, TheUnsavedMarkFollowsTheStateNotTheNumberOfEdits) {
    Document document(smallScene(), "a.glb");
    EXPECT_FALSE(document.isUnsaved());
    document.apply(renameInstance(0, "other"));
    EXPECT_TRUE(document.isUnsaved());
    document.markSaved("b.glb");
    EXPECT_EQ(document.file(), "b.glb");
    EXPECT_FALSE(document.isUnsaved());
    document.undo();
    EXPECT_TRUE(document.isUnsaved());
    document.redo();
    EXPECT_FALSE(document.isUnsaved());
    document.undo();
    document.apply(renameInstance(0, "third"));
    EXPECT_TRUE(document.isUnsaved());
    document.undo();
    EXPECT_TRUE(document.isUnsaved());  // what was saved is out of reach now
}

TEST(EditorDocument, AnEditThatThrowsChangesNothing) {
    Document document(smallScene());
    const Snapshot before = snapshotOf(document);
    const Edit half{"half", [](EditState& state) {
                        state.scene.instances.clear();
                        throw Error("no");
                    }};
    EXPECT_THROW(document.apply(half), Error);
    EXPECT_THROW(document.apply(placeInstances({{0, glm::mat4(0.0f)}}, "Scale")), Error);
    EXPECT_THROW(document.apply(deleteMaterial(0)), Error);
    EXPECT_THROW(document.apply(deleteInstances({0, 1, 2, 3, 4})), Error);
    expectSame(snapshotOf(document), before);
    EXPECT_EQ(document.undoSteps(), 0u);
}

TEST(EditorDocument, HiddenInstancesAreLeftOutOfWhatIsRendered) {
    Document document(smallScene());
    const std::shared_ptr<const Scene> all = document.rendered();
    EXPECT_EQ(all, document.rendered());
    document.apply(showInstances({1, 3}, false));
    ASSERT_EQ(document.rendered()->instances.size(), 3u);
    EXPECT_EQ(document.scene().instances.size(), 5u);
    for (const uint32_t i : {0u, 1u, 2u})
        EXPECT_EQ(document.rendered()->instances[i].name, document.scene().instances[document.sceneInstance(i)].name);
    EXPECT_EQ(document.sceneInstance(1), 2u);
    EXPECT_EQ(all->instances.size(), 5u);  // who holds it keeps it
    document.apply(isolateInstances({1}));
    ASSERT_EQ(document.rendered()->instances.size(), 1u);
    EXPECT_EQ(document.rendered()->instances[0].name, "thing 1");
    document.apply(showAllInstances());
    EXPECT_EQ(document.rendered()->instances.size(), 5u);
    document.undo();
    document.undo();
    EXPECT_TRUE(document.isHidden(3));
    EXPECT_FALSE(document.isHidden(2));
}

TEST(EditorDocument, UndoBringsBackTheSelection) {
    Document document(smallScene());
    document.select({.instances = {1, 2, 1, 77}});
    EXPECT_EQ(document.selection().instances, (std::vector<uint32_t>{1, 2}));
    EXPECT_EQ(document.undoSteps(), 0u);
    document.apply(duplicateInstances({1, 2}));
    EXPECT_EQ(document.selection().instances, (std::vector<uint32_t>{5, 6}));
    document.apply(deleteInstances({5, 6}));
    EXPECT_TRUE(document.selection().instances.empty());
    document.undo();
    EXPECT_EQ(document.selection().instances, (std::vector<uint32_t>{5, 6}));
    document.undo();
    EXPECT_EQ(document.selection().instances, (std::vector<uint32_t>{1, 2}));
}

/// A scene as heavy as a real one: 100 meshes of 20,000 vertices, 76 MB of vertices and 16 MB of texels.
Scene heavyScene() {
    Scene scene = smallScene();
    Mesh mesh = makeShape(Shape::sphere);
    mesh.positions.resize(20000);
    mesh.normals.resize(20000);
    mesh.uvs.resize(20000);
    for (uint32_t m = 0; m < 100; ++m) {
        scene.meshes.push_back(mesh);
        for (int i = 0; i < 10; ++i)
            scene.instances.push_back(
                {"an instance with a long name", static_cast<uint32_t>(scene.meshes.size() - 1), glm::mat4(1.0f)});
    }
    scene.textures.push_back(
        {.name = "large", .width = 2048, .height = 2048, .texels = std::vector<uint32_t>(2048 * 2048)});
    return scene;
}

TEST(EditorDocument, AThousandStepsInAHeavySceneAreLight) {
    Document document(heavyScene());
    const Mesh* mesh = &document.scene().meshes[50];
    const Texture* texture = &document.scene().textures[3];
    for (uint32_t i = 0; i < 1000; ++i) {
        const glm::mat4 matrix = glm::translate(glm::mat4(1.0f), glm::vec3(static_cast<float>(i + 1)));
        ASSERT_TRUE(document.apply(placeInstances({{i % 900, matrix}}, "Move")));
        if (i % 100 == 0) static_cast<void>(document.rendered());
    }
    EXPECT_EQ(document.undoSteps(), 1000u);
    EXPECT_LT(document.historyBytes(), 2u << 20);
    EXPECT_EQ(mesh, &document.scene().meshes[50]) << "an edit has copied a mesh";
    EXPECT_EQ(texture, &document.scene().textures[3]) << "an edit has copied a texture";
    EXPECT_EQ(mesh, &std::as_const(*document.rendered()).meshes[50]) << "a snapshot has copied a mesh";
}

TEST(EditorDocument, AssigningAMaterialDoesNotKeepTheMeshInTheHistory) {
    Document document(heavyScene());
    std::vector<uint32_t> wearers;
    for (uint32_t i = 0; i < 10; ++i) wearers.push_back(5 + i);  // all that show mesh 4
    for (uint32_t i = 0; i < 50; ++i) ASSERT_TRUE(document.apply(assignMaterial(wearers, 1 + i % 3)));
    EXPECT_LT(document.historyBytes(), 1u << 18);
    const uint32_t mesh = document.scene().instances[5].mesh;
    EXPECT_EQ(mesh, 4u);
    for (uint32_t i = 0; i < 50; ++i) document.undo();
    EXPECT_EQ(document.scene().meshes[4].material, 0u);
}

TEST(EditorDocument, EditsSayWhatTheyTouch) {
    const auto kindsOf = [](const Edit& edit) {
        Document document(smallScene());
        const std::shared_ptr<const Scene> before = document.rendered();
        const RenderSettings settings = document.settings();
        document.apply(edit);
        return editKinds(*before, *document.rendered()) | editKinds(settings, document.settings());
    };
    Material glow = smallScene().materials[3];
    glow.roughness = 0.1f;
    EXPECT_EQ(kindsOf(setMaterial(3, glow, "roughness")), kEditMaterials);
    glow.emission = glm::vec3(1.0f);
    EXPECT_EQ(kindsOf(setMaterial(3, glow, "emission")), kEditMaterials | kEditLights);
    glow.alphaMode = AlphaMode::mask;
    EXPECT_EQ(kindsOf(setMaterial(3, glow, "alpha")), kEditMaterials | kEditLights | kEditGeometry);
    EXPECT_EQ(kindsOf(placeInstances({{0, glm::translate(glm::mat4(1.0f), glm::vec3(1.0f))}}, "Move")),
              kEditTransforms);
    EXPECT_EQ(kindsOf(renameInstance(0, "n")), kEditNothing);
    EXPECT_EQ(kindsOf(showInstances({0}, false)), kEditGeometry);
    EXPECT_EQ(kindsOf(duplicateInstances({0})), kEditGeometry);
    EXPECT_EQ(kindsOf(assignMaterial({0}, 2)), kEditMaterials | kEditLights | kEditGeometry);
    EXPECT_EQ(kindsOf(deleteLight(0)), kEditLights);
    EXPECT_EQ(kindsOf(deleteCamera(0)), kEditCamera);
    EXPECT_EQ(kindsOf(removeSurroundings()), kEditEnvironment);
    EXPECT_EQ(kindsOf(setRenderSetting("exposure", "1")), kEditFilm);
    EXPECT_EQ(kindsOf(setRenderSetting("spp", "9")), kEditBudget);
    EXPECT_EQ(kindsOf(setRenderSetting("energy", "multiple")) & kEditTrees, kEditNothing);
    EXPECT_EQ(kindsOf(setRenderSetting("sampler", "blue-noise")) & kEditTrees, kEditNothing);
    EXPECT_EQ(kindsOf(setRenderSetting("integrator", "whitted")), kEditKernel | kEditLights);  // of other lights
    EXPECT_EQ(kindsOf(setRenderSetting("builder", "sweep")), kEditTrees);
}

}  // namespace
}  // namespace raylab::editortest
