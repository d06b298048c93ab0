#include <functional>
#include <ostream>

#include "engine/image/bitmap.h"
#include "engine/render/lighting.h"
#include "engine/render/prepared_settings.h"
#include "engine/scene/import.h"
#include "tests/support/gpu_test.h"
#include "tests/support/paths.h"

/// A scene on the device that is taken up to an edit is the scene that is prepared anew, and no more is uploaded for it
/// than what the edit is about.
namespace raylab::support {
namespace {

constexpr int kMapWidth = 8, kMapHeight = 4;

/// Boxes below a lamp, a point light, a spot light and a map of radiance.
Scene editedScene() {
    Scene scene = importScene(binaryFolder() / "assets/cornell.glb");
    scene.lights.push_back({.name = "point", .position = {200.0f, 400.0f, 200.0f}, .intensity = glm::vec3(4e4f)});
    scene.lights.push_back(
        {.name = "spot", .kind = LightKind::spot, .position = {300.0f, 500.0f, 100.0f}, .intensity = glm::vec3(6e4f)});
    Environment map{Bitmap(kMapWidth, kMapHeight, 3)};
    for (size_t i = 0; i < map.radiance.pixels.size(); ++i)
        map.radiance.pixels[i] = 0.1f + 0.01f * static_cast<float>(i);
    scene.environment = map;
    return scene;
}

size_t lampOf(const Scene& scene) {
    for (size_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].emission != glm::vec3(0.0f)) return i;
    return scene.materials.size();
}

size_t paintOf(const Scene& scene) { return lampOf(scene) == 0 ? 1 : 0; }

size_t materialBytes(const Scene& scene) { return scene.materials.size() * sizeof(shared::MaterialData); }
size_t lightBytes(const Scene& scene) { return scene.lights.size() * sizeof(shared::PunctualData); }

struct EditCase {
    const char* name;
    std::function<void(Scene&)> edit;
    bool environment;                             ///< the edit is one of the map
    std::function<size_t(const Scene&)> uploads;  ///< bytes, of the scene after the edit; more than that is too much
};

void PrintTo(const EditCase& each, std::ostream* out) { *out << each.name; }

const EditCase kEdits[] = {
    {"Nothing", [](Scene&) {}, false, [](const Scene&) { return size_t{0}; }},
    {"Colour",
     [](Scene& s) {
         s.materials[paintOf(s)].baseColor = {0.1f, 0.5f, 0.9f};
     },
     false, materialBytes},
    {"Glass", [](Scene& s) { s.materials[paintOf(s)].transmission = 1.0f; }, false,  // which calls for another kernel
     [](const Scene& s) { return materialBytes(s) + (size_t{1} << 16); }},
    {"BrighterLamp", [](Scene& s) { s.materials[lampOf(s)].emission *= 3.0f; }, false, materialBytes},
    {"LampThatShinesBothWays", [](Scene& s) { s.materials[lampOf(s)].doubleSided ^= true; }, false, materialBytes},
    {"SecondLamp",
     [](Scene& s) {
         s.materials[paintOf(s)].emission = {2.0f, 1.0f, 0.5f};
     },
     false, [](const Scene& s) { return materialBytes(s) + 1000 * sizeof(shared::EmissiveData); }},
    {"MovedLight", [](Scene& s) { s.lights[0].position.x += 50.0f; }, false, lightBytes},
    {"DimmerLight", [](Scene& s) { s.lights[1].intensity *= 0.25f; }, false, lightBytes},
    {"AnotherLight", [](Scene& s) { s.lights.push_back(s.lights[0]); }, false, lightBytes},
    {"OneLightLess", [](Scene& s) { s.lights.pop_back(); }, false, lightBytes},
    // How densely the map is sampled does not change with its scale.
    {"BrighterMap",
     [](Scene& s) {
         for (float& value : s.environment->radiance.pixels) value *= 2.0f;
     },
     true, [](const Scene&) { return kMapWidth * kMapHeight * sizeof(glm::vec4); }},
};

std::vector<float> finish(Renderer& renderer) {
    while (renderer.step()) continue;
    return renderer.snapshot().mean.pixels;
}

void update(Device& device, const EditCase& each, const Scene& scene, const RenderSettings& settings,
            PreparedScene& prepared) {
    updateSettings(device, scene, settings, prepared,
                   {.geometry = false, .instances = false, .textures = false, .environment = each.environment});
}

class EditInPlace : public GpuTest, public ::testing::WithParamInterface<EditCase> {};

TEST_P(EditInPlace, IsTheScenePreparedAnew) {
    const EditCase& each = GetParam();
    RenderSettings settings = smallImage(16, 4, 3);
    settings.lightChoice = "power";  // a tree's nodes would be uploaded with the lights
    Scene scene = editedScene();
    const auto prepared = std::make_shared<PreparedScene>(prepareScene(device_, scene, settings));
    Renderer renderer(device_, prepared, settings);
    const std::vector<float> before = finish(renderer);
    each.edit(scene);
    const uint64_t uploaded = prepared->gpu->uploadedBytes();
    update(device_, each, scene, settings, *prepared);
    EXPECT_LE(prepared->gpu->uploadedBytes() - uploaded, each.uploads(scene));
    renderer.restart(settings, prepared->camera);
    Renderer fresh(device_, scene, settings);
    const std::vector<float> pixels = finish(renderer);
    EXPECT_EQ(pixels, finish(fresh));
    EXPECT_EQ(pixels == before, std::string_view(each.name) == "Nothing");
}

INSTANTIATE_TEST_SUITE_P(Edits, EditInPlace, ::testing::ValuesIn(kEdits),
                         [](const auto& each) { return std::string(each.param.name); });

class EditsInPlace : public GpuTest {};

/// One after another, below a tree over lights, which follows them.
TEST_F(EditsInPlace, InARowAreTheScenePreparedAnew) {
    RenderSettings settings = smallImage(16, 4, 3);
    settings.lightChoice = "tree";
    Scene scene = editedScene();
    const auto prepared = std::make_shared<PreparedScene>(prepareScene(device_, scene, settings));
    Renderer renderer(device_, prepared, settings);
    for (const EditCase& each : kEdits) {
        each.edit(scene);
        update(device_, each, scene, settings, *prepared);
    }
    renderer.restart(settings, prepared->camera);
    Renderer fresh(device_, scene, settings);
    EXPECT_EQ(finish(renderer), finish(fresh));
}

/// What moves is not its mesh: matrices, and the tree over them, are all that is uploaded.
TEST_F(EditsInPlace, AMoveUploadsNoGeometry) {
    Scene scene = editedScene();
    RenderSettings settings = smallImage(8, 1, 2);
    settings.trees = "mesh";
    PreparedScene prepared = prepareScene(device_, scene, settings);
    scene.instances.back().objectToWorld[3].x += 10.0f;
    const uint64_t before = prepared.gpu->uploadedBytes();
    prepared.gpu->update(device_, scene, prepared.lightConfig,
                         {.geometry = false, .instances = true, .textures = false, .environment = false});
    EXPECT_EQ(prepared.gpu->uploadedBytes() - before, scene.instances.size() * sizeof(shared::InstanceData));
}

}  // namespace
}  // namespace raylab::support
