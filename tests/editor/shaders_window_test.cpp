#include <glm/glm.hpp>

#include "engine/image/image_io.h"
#include "tests/editor/window.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

/// The editor from a folder of its own, with sources of its own beside it.
class ShadersWindowTest : public support::WindowTest {
protected:
    void SetUp() override {
        WindowTest::SetUp();
        if (IsSkipped() || HasFailure()) return;
        const fs::path built = support::binaryFolder(), tree = folder_ / "tree";
        fs::create_directories(tree / "shaders");
        fs::copy_file(built / "raylab", tree / "raylab");
        fs::create_directory_symlink(built / "assets", tree / "assets");
        for (const fs::directory_entry& entry : fs::directory_iterator(built / "shaders"))
            if (entry.path().extension() == ".spv") fs::copy(entry.path(), tree / "shaders");
        fs::copy(support::sourceFolder() / "shaders", folder_ / "glsl", fs::copy_options::recursive);
        std::ifstream stream(built / "shaders/commands.txt");
        std::string text{std::istreambuf_iterator<char>(stream), {}};
        const std::string from = (support::sourceFolder() / "shaders").string(), to = (folder_ / "glsl").string();
        for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
        writeFile("tree/shaders/commands.txt", text);
        program_ = tree / "raylab";
    }
    /// The user's shell: what `edit` does with sed, once the script has taken a picture of that name.
    static std::string onPicture(const std::string& name, const std::string& edit) {
        return "while [ ! -e " + name + " ]; do sleep .05; done\n" + edit + "\n";
    }
};

const std::string kScene = "cornell --depth 2 --spp 1 --layout bvh4b ";
/// What the view of normals shows is painted green, or names what is not there.
const std::string kPaint =
    "sed -i 's/return integrateView(ray, cone, random);/return vec3(0.0, 1.0, 0.0);/' "
    "glsl/integrators/integrate.glsl";
const std::string kBreak =
    "sed -i 's/return integrateView(ray, cone, random);/return nonsense;/' "
    "glsl/integrators/integrate.glsl";

const std::string kBreakPainted =
    "sed -i 's/return vec3(0.0, 1.0, 0.0);/return nonsense;/' glsl/integrators/integrate.glsl";

TEST_F(ShadersWindowTest, TakesUpAChangeOfASource) {
    EXPECT_EQ(runScript(kScene + "--integrator normal ",
                        "wait-idle\nremember picture-contrast\nscreenshot before.png\n"
                        "wait-until picture-contrast != remembered\nwait-idle\nassert errors == 0\n"
                        "screenshot after.png\nquit\n",
                        onPicture("before.png", kPaint)),
              0)
        << readFile("log");
    const Bitmap window = readImage(folder_ / "after.png");
    const float* middle = window.at(600, 300);
    EXPECT_GT(middle[1], 0.9f);
    EXPECT_LT(middle[0] + middle[2], 0.1f);
}

/// A picture that is rendered to a file is of the sources as they are: of the changed one, or of the last that
/// compiled.
TEST_F(ShadersWindowTest, RendersToAFileWithTheKernelsOfTheSources) {
    EXPECT_EQ(runScript(kScene + "--integrator normal --width 32 --height 18 ",
                        "wait-idle\nkey p\nscreenshot before.png\nwait 0.2\nkey F11\nwait 0.2\nwait-until job == \"\"\n"
                        "assert errors == 0\nscreenshot painted.png\nwait-until errors == 1\nkey F11\nwait 0.2\n"
                        "wait-until job == \"\"\nassert errors == 1\nquit\n",
                        onPicture("before.png", kPaint) + onPicture("painted.png", kBreakPainted)),
              0)
        << readFile("log");
    for (const char* name : {"raylab-cornell-1.png", "raylab-cornell-2.png"}) {
        const Bitmap picture = readImage(folder_ / name);
        const float* middle = picture.at(16, 9);
        EXPECT_GT(middle[1], 0.9f) << name;
        EXPECT_LT(middle[0] + middle[2], 0.1f) << name;
    }
}

TEST_F(ShadersWindowTest, KeepsTheKernelWhereASourceIsWrong) {
    EXPECT_EQ(runScript(kScene + "--integrator normal ",
                        "wait-idle\nremember picture-contrast\nscreenshot before.png\n"
                        "wait-until errors == 1\nwait-until error contains integrate.glsl\n"
                        "assert picture-contrast == remembered\nset exposure 1\nwait 0.3\nassert errors == 1\n"
                        "key w\nwait-idle\nassert samples == 1\nscreenshot error.png\nquit\n",
                        onPicture("before.png", kBreak)),
              0)
        << readFile("log");
    EXPECT_NE(readFile("log").find("integrate.glsl:"), std::string::npos) << readFile("log");
}

TEST_F(ShadersWindowTest, F5SaysWhereThereAreNoSources) {
    fs::remove(folder_ / "tree/shaders/commands.txt");
    EXPECT_EQ(runScript(kScene, "wait-idle\nkey F5\nwait 0.3\nwait-idle\nassert errors == 0\nquit\n"), 0)
        << readFile("log");
    EXPECT_NE(readFile("log").find("without its shaders' sources"), std::string::npos) << readFile("log");
}

}  // namespace
}  // namespace raylab
