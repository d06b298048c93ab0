#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/gpu/shader_sources.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

/// A source tree of two kernels of which one includes a file, compiled as raylab's own build compiles.
class ShaderSourcesTest : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(root_ / "glsl/lib");
        fs::create_directories(root_ / "kernels");
        write("glsl/lib/value.glsl", "float value() { return 1.0; }\n");
        write("glsl/a.comp", head() + "#include \"lib/value.glsl\"\n" + body("value()"));
        write("glsl/b.comp", head() + body("2.0"));
        std::ifstream build(support::binaryFolder() / "shaders" / kShaderCommandsFile);
        std::string compiler;
        std::getline(build, compiler);
        std::getline(build, compiler, '\t');
        std::getline(build, compiler, '\t');
        std::string commands = (root_ / "glsl").string() + "\n";
        for (const std::string entry : {"a.comp", "b.comp"}) {
            commands += entry + "\t" + compiler + "\t--quiet\t--target-env\tvulkan1.2\t-I" + (root_ / "glsl").string() +
                        "\t" + (root_ / "glsl" / entry).string() + "\n";
            write("kernels/" + entry + ".spv", "as built");
        }
        write("kernels/commands.txt", commands);
    }
    static std::string head() {
        return "#version 460\n#extension GL_GOOGLE_include_directive : require\n"
               "layout(set = 0, binding = 0) buffer Out { float result; };\n";
    }
    static std::string body(const std::string& value) { return "void main() { result = " + value + "; }\n"; }
    void write(const std::string& name, const std::string& text) const { std::ofstream(root_ / name) << text; }
    std::string read(const std::string& name) const {
        std::ostringstream text;
        text << std::ifstream(root_ / name, std::ios::binary).rdbuf();
        return text.str();
    }
    static bool all(const std::string&) { return true; }
    static bool onlyA(const std::string& entry) { return entry == "a.comp"; }

    const support::ScratchFolder scratch_{"raylab sources"};
    const fs::path root_ = scratch_.path();
};

TEST_F(ShaderSourcesTest, CompilesWhatHasChangedAndIsWanted) {
    ShaderSources sources(root_ / "kernels");
    ASSERT_EQ(sources.missing(), "");
    EXPECT_EQ(sources.refresh(all), 0u);
    EXPECT_EQ(read("kernels/a.comp.spv"), "as built");
    const Hash128 before = sources.stamp();
    write("glsl/lib/value.glsl", "float value() { return 31.0; }\n");
    EXPECT_FALSE(sources.stamp() == before);
    const uint64_t first = sources.refresh(onlyA);
    EXPECT_GT(first, 0u);
    const std::string a = read("kernels/a.comp.spv");
    EXPECT_EQ(a.substr(0, 4), "\x03\x02\x23\x07") << "SPIR-V's magic number";
    EXPECT_EQ(read("kernels/b.comp.spv"), "as built");
    EXPECT_EQ(sources.refresh(onlyA), first);
    // b.comp does not include the file that changes now: only the first time it is compiled without need.
    sources.refresh(all);
    const uint64_t second = sources.refresh(all);
    write("glsl/lib/value.glsl", "float value() { return 47.5; }\n");
    const std::string b = read("kernels/b.comp.spv");
    EXPECT_GT(sources.refresh(all), second);
    EXPECT_NE(read("kernels/a.comp.spv"), a);
    EXPECT_EQ(read("kernels/b.comp.spv"), b);
}

TEST_F(ShaderSourcesTest, SaysFileAndLineAndKeepsTheKernel) {
    ShaderSources sources(root_ / "kernels");
    write("glsl/lib/value.glsl", "// one line\nfloat value() { return nothing; }\n");
    try {
        sources.refresh(all);
        FAIL() << "an error was not noticed";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("value.glsl:2:"), std::string::npos) << text;
        EXPECT_NE(text.find("nothing"), std::string::npos) << text;
    }
    EXPECT_EQ(read("kernels/a.comp.spv"), "as built");
    EXPECT_EQ(read("kernels/b.comp.spv"), "as built") << "compiled, but not all of them were";
    write("glsl/lib/value.glsl", "float value() { return 3.0; }\n");
    EXPECT_GT(sources.refresh(all), 0u);
}

TEST_F(ShaderSourcesTest, AnInstalledOneHasNone) {
    fs::remove(root_ / "kernels/commands.txt");
    ShaderSources sources(root_ / "kernels");
    EXPECT_NE(sources.missing().find("commands.txt"), std::string::npos);
    EXPECT_EQ(sources.refresh(all), 0u);
}

TEST_F(ShaderSourcesTest, SaysWhatIsMissing) {
    fs::remove_all(root_ / "glsl");
    EXPECT_NE(ShaderSources(root_ / "kernels").missing().find("no longer there"), std::string::npos);
}

}  // namespace
}  // namespace raylab
