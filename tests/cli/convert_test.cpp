#include "tests/cli/program.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

class Convert : public ProgramTest {
protected:
    void SetUp() override {
        writeText("box.obj", "mtllib box.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        writeText("box.mtl", "newmtl red\nKd 0.7 0.1 0.1\nmap_Kd absent.png\n");
        writeText("ball.gltf",
                  R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
                  "nodes": [{"extras": {"raylab": {"quadrics": 0}}},
                            {"extras": {"raylab": {"quadrics": 0}}, "translation": [3, 0, 0]}],
                  "extras": {"raylab": {"quadrics": [{"surfaces": [{"kind": "sphere"}]}]}}})");
    }
};

TEST_F(Convert, ObjBecomesGlb) {
    ASSERT_EQ(runProgram("convert box.obj -o box.glb --json facts.json"), 0) << text("err");
    EXPECT_NE(text("err").find("absent.png"), std::string::npos) << "the warnings of the import are passed on";
    EXPECT_NE(text("out").find("box.glb"), std::string::npos);
    const Json facts = Json::parse(text("facts.json"));
    EXPECT_EQ(facts["schema"], "raylab.convert/1");
    EXPECT_EQ(facts["triangles"], 1);
    EXPECT_EQ(facts["quadrics"], 0);
    EXPECT_EQ(facts["materials"], 1);
    EXPECT_EQ(facts["warnings"].size(), 1u);
    EXPECT_EQ(facts["bytes"], fs::file_size(folder_ / "box.glb"));
    const std::string glb = text("box.glb");
    ASSERT_TRUE(glb.starts_with("glTF"));
    EXPECT_NE(glb.find("\"red\""), std::string::npos);
}

TEST_F(Convert, JsonAloneOnStandardOutput) {
    ASSERT_EQ(runProgram("convert ball.gltf -o new/ball.glb --json -"), 0) << text("err");
    const Json facts = Json::parse(text("out"));
    EXPECT_EQ(facts["quadrics"], 1);
    EXPECT_EQ(facts["instances"], 2);
    EXPECT_TRUE(fs::exists(folder_ / "new/ball.glb")) << "missing folders are made";
}

TEST_F(Convert, InputAndOutputMayBeTheSame) {
    ASSERT_EQ(runProgram("convert box.obj -o box.gltf"), 0) << text("err");
    const std::string document = text("box.gltf"), buffer = text("box.bin");
    ASSERT_FALSE(buffer.empty());
    ASSERT_EQ(runProgram("convert box.gltf -o box.gltf"), 0) << text("err");
    EXPECT_EQ(text("box.gltf"), document);
    EXPECT_EQ(text("box.bin"), buffer);
    ASSERT_EQ(runProgram("convert box.gltf -o box.glb"), 0) << text("err");
    const std::string binary = text("box.glb");
    ASSERT_EQ(runProgram("convert box.glb -o box.glb"), 0) << text("err");
    EXPECT_EQ(text("box.glb"), binary);
}

TEST_F(Convert, BadInputWritesNothing) {
    writeText("broken.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": 7}");
    writeText("old.glb", "the user's own");
    const std::pair<const char*, const char*> cases[] = {{"absent.obj", "no such file"},
                                                         {"broken.gltf", "nodes must be an array"},
                                                         {"box.mtl", "is not a scene format that is read"}};
    for (const auto& [input, what] : cases) {
        EXPECT_EQ(runProgram(std::string("convert ") + input + " -o old.glb"), 2) << input;
        EXPECT_NE(text("err").find(what), std::string::npos) << text("err");
        EXPECT_EQ(text("old.glb"), "the user's own");
    }
}

TEST_F(Convert, BadOutputIsRefusedBeforeTheWork) {
    EXPECT_EQ(runProgram("convert box.obj -o box.ply"), 2);
    EXPECT_NE(text("err").find("use .glb or .gltf"), std::string::npos) << text("err");
    EXPECT_FALSE(fs::exists(folder_ / "box.ply"));
    fs::create_directory(folder_ / "folder.glb");
    EXPECT_EQ(runProgram("convert box.obj -o folder.glb"), 2);
    EXPECT_NE(text("err").find("is a folder"), std::string::npos) << text("err");
    EXPECT_EQ(runProgram("convert box.obj"), 2) << "where to?";
}

TEST_F(Convert, InfoCountsQuadrics) {
    ASSERT_EQ(runProgram("info ball.gltf --json facts.json"), 0) << text("err");
    const Json facts = Json::parse(text("facts.json"));
    EXPECT_EQ(facts["quadrics"], 1);
    EXPECT_EQ(facts["instancedQuadrics"], 2);
    EXPECT_EQ(facts["triangles"], 0);
    EXPECT_NE(text("out").find("1 stored, 2 shown"), std::string::npos);
}

}  // namespace
}  // namespace raylab
