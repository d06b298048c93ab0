#include <cmath>
#include <sstream>

#include "engine/image/image_io.h"
#include "import_support.h"

namespace raylab::importtest {
namespace {

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

/// One triangle with a material "m" of the given MTL lines.
fs::path writeWith(const ScratchFolder& folder, const std::string& mtl) {
    folder.write("a.mtl", "newmtl m\n" + mtl);
    return folder.write("a.obj", "mtllib a.mtl\nusemtl m\n" + std::string(kTriangle));
}

Material materialOf(const std::string& mtl) {
    const ScratchFolder folder;
    const Scene scene = importScene(writeWith(folder, mtl));
    EXPECT_EQ(scene.materials.size(), 1u);
    return scene.materials.at(0);
}

void writeImage(const fs::path& path, const std::vector<float>& rgb) {
    Bitmap bitmap(static_cast<int>(rgb.size() / 3), 1, 3);
    bitmap.pixels = rgb;
    writePng(path, bitmap);
}

TEST(ImportObj, KdAloneIsLambertian) {
    const Material material = materialOf("Kd 0.1 0.2 0.3\n");
    EXPECT_EQ(material.name, "m");
    EXPECT_EQ(material.baseColor, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.specular, 0.0f);
    EXPECT_EQ(material.metallic, 0.0f);
    EXPECT_EQ(material.transmission, 0.0f);
    EXPECT_EQ(material.alphaMode, AlphaMode::opaque);
}

/// Walter et al. 2007: alpha = sqrt(2 / (Ns + 2)); the material stores its square root.
/// Found by ImportFuzz: Assimp wrote the shininess of no material through a null pointer.
TEST(ImportObj, StatementsBeforeTheFirstMaterialAreLeftOut) {
    const ScratchFolder folder;
    folder.write("a.mtl", "# made by hand\nNs 20\n  d 0.5\nnewmtl m\nKd 0.1 0.2 0.3\n");
    const Scene scene = importScene(folder.write("a.obj", "mtllib a.mtl\nusemtl m\n" + std::string(kTriangle)));
    EXPECT_EQ(scene.materials.at(0).baseColor, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_TRUE(anyContains(scene.warnings, "before its first newmtl")) << joined(scene.warnings);
    folder.write("a.mtl", "\n# a comment alone\nnewmtl m\nKd 0.1 0.2 0.3\n");
    EXPECT_TRUE(importScene(folder.path() / "a.obj").warnings.empty());
}

TEST(ImportObj, KsAndNsAreAGlossyCoat) {
    const Material material = materialOf("Kd 0.5 0.5 0.5\nKs 0.2 0.4 0.3\nNs 98\nNi 1.4\nillum 2\n");
    EXPECT_FLOAT_EQ(material.specular, 0.4f);
    EXPECT_NEAR(material.roughness * material.roughness, std::sqrt(2.0f / 100.0f), 1e-6f);
    EXPECT_FLOAT_EQ(material.ior, 1.4f);
}

TEST(ImportObj, KeEmits) { EXPECT_EQ(materialOf("Kd 0 0 0\nKe 17 12 4\n").emission, glm::vec3(17, 12, 4)); }

TEST(ImportObj, GlassByIlluminationModelOrFilter) {
    for (const char* mtl :
         {"Kd 0 0 0\nKs 1 1 1\nTf 0.9 0.8 0.7\nNi 1.45\nillum 7\n",
          "Kd 0 0 0\nTf 0.9 0.8 0.7\nNi 1.45\nd 0.2\nillum 2\n", "Kd 0 0 0\nTf 0.9 0.8 0.7\nNi 1.45\nillum 4\n"}) {
        const Material material = materialOf(mtl);
        EXPECT_EQ(material.transmission, 1.0f) << mtl;
        EXPECT_EQ(material.baseColor, glm::vec3(0.9f, 0.8f, 0.7f)) << mtl;
        EXPECT_FLOAT_EQ(material.ior, 1.45f) << mtl;
        EXPECT_FALSE(material.thin) << mtl;
        EXPECT_EQ(material.alpha, 1.0f) << mtl;
        EXPECT_EQ(material.alphaMode, AlphaMode::opaque) << mtl;
        EXPECT_EQ(material.roughness, 0.0f) << mtl;
    }
}

TEST(ImportObj, MirrorByIlluminationModel) {
    const Material material = materialOf("Kd 0.1 0.1 0.1\nKs 0.9 0.8 0.7\nillum 3\n");
    EXPECT_EQ(material.metallic, 1.0f);
    EXPECT_EQ(material.roughness, 0.0f);
    EXPECT_EQ(material.baseColor, glm::vec3(0.9f, 0.8f, 0.7f));
}

TEST(ImportObj, DissolveAndItsOpposite) {
    for (const char* mtl : {"Kd 1 1 1\nd 0.25\n", "Kd 1 1 1\nTr 0.75\n"}) {
        const Material material = materialOf(mtl);
        EXPECT_FLOAT_EQ(material.alpha, 0.25f) << mtl;
        EXPECT_EQ(material.alphaMode, AlphaMode::blend) << mtl;
    }
}

TEST(ImportObj, RoughnessAndMetalnessOfThePbrExtension) {
    const Material material = materialOf("Kd 1 1 1\nKs 1 1 1\nNs 98\nPr 0.3\nPm 0.7\n");
    EXPECT_FLOAT_EQ(material.roughness, 0.3f);
    EXPECT_FLOAT_EQ(material.metallic, 0.7f);
}

TEST(ImportObj, TexturesWithBackslashesAndSpaces) {
    const ScratchFolder folder;
    fs::create_directories(folder.path() / "my maps");
    writeImage(folder.path() / "my maps/red.png", {1, 0, 0});
    const Scene scene = importScene(writeWith(folder, "Kd 1 1 1\nmap_Kd my maps\\red.png\n"));
    ASSERT_EQ(scene.textures.size(), 1u) << joined(scene.warnings);
    EXPECT_TRUE(scene.textures[0].srgb);
    EXPECT_EQ(scene.textures[0].texels[0], 0xFF0000FFu);
    EXPECT_EQ(scene.materials[0].baseColorTexture, 0);
    EXPECT_EQ(scene.meshes[0].uvs[2], glm::vec2(0, 0)) << "OBJ counts v upwards, Scene downwards";
    EXPECT_EQ(scene.meshes[0].uvs[0], glm::vec2(0, 1));
}

TEST(ImportObj, AlphaMapJoinsTheColor) {
    const ScratchFolder folder;
    writeImage(folder.path() / "color.png", {1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1});
    writeImage(folder.path() / "alpha.png", {0, 0, 0, 1, 1, 1});
    const Scene scene = importScene(writeWith(folder, "Kd 1 1 1\nmap_Kd color.png\nmap_d alpha.png\n"));
    ASSERT_EQ(scene.textures.size(), 1u) << joined(scene.warnings);
    EXPECT_EQ(scene.textures[0].texels, (std::vector<uint32_t>{0x000000FFu, 0x000000FFu, 0xFFFF0000u, 0xFFFF0000u}));
    EXPECT_EQ(scene.materials[0].alphaMode, AlphaMode::mask);
}

TEST(ImportObj, AlphaMapAlone) {
    const ScratchFolder folder;
    writeImage(folder.path() / "alpha.png", {0, 0, 0, 1, 1, 1});
    const Scene scene = importScene(writeWith(folder, "Kd 1 1 1\nmap_d alpha.png\n"));
    ASSERT_EQ(scene.textures.size(), 1u) << joined(scene.warnings);
    EXPECT_EQ(scene.textures[0].texels, (std::vector<uint32_t>{0x00FFFFFFu, 0xFFFFFFFFu}));
}

TEST(ImportObj, GreyBumpMapIsLeftOutAndColouredOneIsANormalMap) {
    const ScratchFolder folder;
    writeImage(folder.path() / "grey.png", {0.5, 0.5, 0.5, 0.2, 0.2, 0.2});
    writeImage(folder.path() / "normal.png", {0.5, 0.5, 1, 0.5, 0.6, 0.9});
    const Scene grey = importScene(writeWith(folder, "Kd 1 1 1\nmap_Bump grey.png\n"));
    EXPECT_EQ(grey.materials[0].normalTexture, kNoTexture);
    EXPECT_TRUE(anyContains(grey.warnings, "height map")) << joined(grey.warnings);
    const Scene normal = importScene(writeWith(folder, "Kd 1 1 1\nmap_Bump normal.png\n"));
    EXPECT_EQ(normal.materials[0].normalTexture, 0) << joined(normal.warnings);
    EXPECT_FALSE(normal.textures[0].srgb);
    // u grows along +X and, counted upwards as in the file, v along +Y: not mirrored.
    ASSERT_EQ(normal.meshes[0].tangents.size(), 3u);
    EXPECT_EQ(normal.meshes[0].tangents[0], glm::vec4(1, 0, 0, 1));
}

TEST(ImportObj, MissingTextureNamesFileAndMaterial) {
    const ScratchFolder folder;
    const Scene scene = importScene(writeWith(folder, "Kd 0.5 0.5 0.5\nmap_Kd gone.png\n"));
    EXPECT_EQ(scene.materials[0].baseColorTexture, kNoTexture);
    ASSERT_EQ(scene.warnings.size(), 1u) << joined(scene.warnings);
    EXPECT_TRUE(anyContains(scene.warnings, "gone.png"));
    EXPECT_TRUE(anyContains(scene.warnings, "\"m\""));
}

TEST(ImportObj, MissingMaterialLibraryIsGrey) {
    const ScratchFolder folder;
    const Scene scene = importScene(folder.write("a.obj", "mtllib gone.mtl\nusemtl m\n" + std::string(kTriangle)));
    EXPECT_TRUE(anyContains(scene.warnings, "gone.mtl")) << joined(scene.warnings);
    EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(ImportObj, WithoutNormalsIsFlatAndVerticesAreWelded) {
    const ScratchFolder folder;
    const Scene scene =
        importScene(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nf 1 2 4\n"));
    EXPECT_TRUE(scene.meshes[0].normals.empty());
    EXPECT_EQ(scene.meshes[0].positions.size(), 4u);
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec3(0.8f));
}

TEST(ImportObj, WeldingKeepsSeams) {
    const ScratchFolder folder;
    const Scene scene = importScene(folder.write("a.obj",
                                                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\n"
                                                 "f 1//1 2//1 3//1\nf 1//2 3//2 4//2\n"));
    EXPECT_EQ(scene.meshes[0].positions.size(), 6u) << "two of the corners have two normals each";
    expectSound(scene);
}

/// The area of a polygon, by the shoelace formula, equals that of its triangles, all of them wound alike.
TEST(ImportObj, PolygonsKeepTheirArea) {
    const std::vector<std::vector<glm::vec2>> polygons = {
        {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
        {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {4, 3}, {4, 4}, {0, 4}},                 // a C
        {{0, 0}, {4, 4}, {0, 1}, {-4, 4}},                                                // an arrow head
        {{0, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0.5f, 1}, {0.5f, 2}, {0, 2}}};  // with a straight corner
    for (size_t p = 0; p < polygons.size(); ++p) {
        const ScratchFolder folder;
        std::ostringstream text, face;
        face << "f";
        double area = 0.0;
        for (size_t i = 0; i < polygons[p].size(); ++i) {
            const glm::vec2 a = polygons[p][i], b = polygons[p][(i + 1) % polygons[p].size()];
            area += 0.5 * (a.x * b.y - b.x * a.y);
            text << "v " << a.x << ' ' << a.y << " 3\n";
            face << ' ' << i + 1;
        }
        const Scene scene = importScene(folder.write("polygon.obj", text.str() + face.str() + "\n"));
        const Mesh& mesh = scene.meshes[0];
        EXPECT_EQ(mesh.triangles.size(), polygons[p].size() - 2);
        double sum = 0.0;
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::vec3 a = mesh.positions[t.x];
            const double z = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a).z;
            EXPECT_GE(z, 0.0) << "polygon " << p;
            sum += 0.5 * z;
        }
        EXPECT_NEAR(sum, area, 1e-6) << "polygon " << p;
    }
}

TEST(ImportObj, NanVertexAndIndexOutOfRange) {
    const ScratchFolder folder;
    const Scene scene = importScene(folder.write("a.obj", std::string(kTriangle) + "v nan 0 0\nf 1 2 4\n"));
    expectSound(scene);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 1u);
    EXPECT_TRUE(anyContains(scene.warnings, "not finite or beyond 1e18: 1")) << joined(scene.warnings);
    EXPECT_NE(errorOf(folder.write("b.obj", "v 0 0 0\nv 1 0 0\nf 1 2 77\n")), "");
}

TEST(ImportObj, OnlyLinesIsNothingToRender) {
    const ScratchFolder folder;
    const std::string error = errorOf(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"));
    EXPECT_NE(error.find("nothing to render"), std::string::npos) << error;
    EXPECT_NE(error.find("points and lines left out"), std::string::npos) << error;
}

}  // namespace
}  // namespace raylab::importtest
