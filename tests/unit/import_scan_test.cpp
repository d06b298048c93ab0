#include <sstream>

#include "import_support.h"

namespace raylab::importtest {
namespace {

std::string plyOf(const std::vector<glm::vec3>& vertices, const std::vector<std::vector<int>>& faces) {
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << vertices.size()
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << faces.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const glm::vec3& v : vertices) text << v.x << ' ' << v.y << ' ' << v.z << '\n';
    for (const std::vector<int>& face : faces) {
        text << face.size();
        for (const int index : face) text << ' ' << index;
        text << '\n';
    }
    return text.str();
}

std::vector<glm::vec3> cubeCorners() {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    return corners;
}

/// Outward, cut along diagonals that favour some corners: three corners have one triangle a side, others two.
const std::vector<std::vector<int>> kCubeTriangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

/// Weighted by angles, the normal at a cube's corner is its diagonal however the sides are cut. Area weights fail this.
TEST(ImportPly, SmoothNormalsDoNotDependOnTheTessellation) {
    const ScratchFolder folder;
    const Scene scene = importScene(folder.write("cube.ply", plyOf(cubeCorners(), kCubeTriangles)));
    expectSound(scene);
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.normals.size(), 8u);
    for (size_t i = 0; i < 8; ++i) expectNear(mesh.normals[i], glm::normalize(mesh.positions[i]), 1e-6f);
}

TEST(ImportPly, SmoothNormalsSurviveTinyScales) {
    const ScratchFolder folder;
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1e-20 0 0\n0 1e-20 0\n3 0 1 2\n";
    const Scene scene = importScene(folder.write("tiny.ply", text));
    EXPECT_EQ(scene.meshes[0].normals, std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
}

TEST(ImportPly, BinaryEqualsAscii) {
    const ScratchFolder folder;
    const Scene ascii = importScene(folder.write("a.ply", plyOf(cubeCorners(), kCubeTriangles)));
    std::string binary =
        "ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
        "property float z\nelement face 12\nproperty list uchar int vertex_indices\nend_header\n";
    binary += bytesOf(cubeCorners());
    for (const std::vector<int>& face : kCubeTriangles) binary += '\3' + bytesOf(face);
    const Scene read = importScene(folder.write("b.ply", binary));
    EXPECT_EQ(ascii.meshes[0].positions, read.meshes[0].positions);
    EXPECT_EQ(ascii.meshes[0].triangles, read.meshes[0].triangles);
    for (const size_t cut : {binary.size() - 1, binary.size() - 100, size_t{230}, size_t{60}, size_t{3}, size_t{0}})
        EXPECT_NE(errorOf(folder.write("cut.ply", binary.substr(0, cut))), "") << cut;
}

TEST(ImportPly, DamagedHeadersNameTheLine) {
    const ScratchFolder folder;
    const std::string good = plyOf(cubeCorners(), kCubeTriangles);
    const auto errorWith = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return errorOf(folder.write("damaged.ply", text));
    };
    EXPECT_NE(errorWith("property float y", "property flout y").find("damaged.ply:5: damaged PLY: \"flout\""),
              std::string::npos);
    EXPECT_NE(errorWith("end_header", "end_heade").find("damaged.ply:9"), std::string::npos);
    EXPECT_NE(errorWith("vertex 8", "vertex 4000000000").find("damaged PLY"), std::string::npos);
    EXPECT_NE(errorWith("face 12", "face 13").find("ends too early"), std::string::npos);
    EXPECT_NE(errorWith("3 0 2 1", "3 0 2").find("damaged.ply:18: damaged PLY: a number is missing"),
              std::string::npos);
    EXPECT_NE(errorWith("3 0 2 1", "900000 0 2 1").find("wrong length"), std::string::npos);
    EXPECT_NE(errorWith("ascii", "ebcdic").find("not a format"), std::string::npos);
}

TEST(ImportPly, IndexOutOfRangeIsCounted) {
    const ScratchFolder folder;
    const Scene scene = importScene(folder.write("a.ply", plyOf(cubeCorners(), {{0, 1, 2}, {0, 1, 99}, {0, 1, -1}})));
    expectSound(scene);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions.size(), 3u);
    EXPECT_TRUE(anyContains(scene.warnings, "do not exist: 2")) << joined(scene.warnings);
}

std::string asciiStl(const std::string& vertices) {
    return "solid s\nfacet normal 0 0 1\nouter loop\n" + vertices + "endloop\nendfacet\nendsolid s\n";
}

TEST(ImportStl, AsciiIsFlatAndGrey) {
    const ScratchFolder folder;
    const Scene scene = importScene(folder.write("a.stl", asciiStl("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n")));
    EXPECT_EQ(scene.meshes.at(0).positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_TRUE(scene.meshes[0].normals.empty());
    EXPECT_EQ(scene.materials.at(0).baseColor, glm::vec3(0.8f));
}

TEST(ImportStl, BinaryIsWelded) {
    const ScratchFolder folder;
    std::string binary(80, ' ');
    binary += bytesOf(std::vector<uint32_t>{12});
    const std::vector<glm::vec3> corners = cubeCorners();
    for (const std::vector<int>& face : kCubeTriangles) {
        binary += bytesOf(std::vector<float>{0, 0, 1});
        for (const int index : face) binary += bytesOf(std::vector<glm::vec3>{corners[static_cast<size_t>(index)]});
        binary += std::string(2, '\0');
    }
    const Scene scene = importScene(folder.write("cube.STL", binary));
    EXPECT_EQ(scene.meshes[0].triangles.size(), 12u);
    EXPECT_EQ(scene.meshes[0].positions.size(), 8u);
    EXPECT_NE(errorOf(folder.write("cut.stl", binary.substr(0, 300))), "");
}

TEST(ImportScene, FolderMissingFileAndUnknownExtension) {
    const ScratchFolder folder;
    EXPECT_NE(errorOf(folder.path()).find("folder"), std::string::npos);
    EXPECT_NE(errorOf(folder.path() / "gone.glb").find("no such file"), std::string::npos);
    const std::string error = errorOf(folder.write("scene.docx", "hello"));
    EXPECT_NE(error.find(".docx"), std::string::npos) << error;
    EXPECT_NE(error.find(".gltf .glb .obj .ply .stl"), std::string::npos) << error;
    EXPECT_NE(errorOf(folder.write("noextension", "hello")), "");
}

TEST(ImportScene, EmptyFilesOfEveryFormat) {
    const ScratchFolder folder;
    for (const char* name : {"a.gltf", "a.glb", "a.obj", "a.ply", "a.stl"}) {
        const std::string error = errorOf(folder.write(name, ""));
        EXPECT_NE(error.find(name), std::string::npos) << name << ": " << error;
    }
}

}  // namespace
}  // namespace raylab::importtest
