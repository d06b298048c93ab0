#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "engine/image/image_io.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;
const fs::path kProgram = support::binaryFolder() / "raylab";

struct Outcome {
    int exitCode = -1;
    std::string out;
    std::string err;
};

std::string textOf(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Runs the program the way a user does, in a folder of its own for each test.
class CommandLine : public testing::Test {
protected:
    pid_t start(const std::vector<std::string>& arguments) {
        const pid_t child = ::fork();
        if (child != 0) return child;
        std::vector<std::string> words = arguments;
        words.insert(words.begin(), kProgram.string());
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        if (::chdir(folder_.c_str()) != 0 || !std::freopen("stdout", "w", stdout) ||
            !std::freopen("stderr", "w", stderr))
            ::_exit(127);
        ::execv(kProgram.c_str(), pointers.data());
        ::_exit(127);
    }

    Outcome finish(pid_t child) {
        int status = 0;
        ::waitpid(child, &status, 0);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(folder_ / "stdout"), textOf(folder_ / "stderr")};
    }

    /// Ctrl-C, once `what` is among what the program has printed.
    void interruptAfter(pid_t child, const char* stream, const char* what) const {
        for (int tries = 0; tries < 600 && textOf(folder_ / stream).find(what) == std::string::npos; ++tries)
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        ::kill(child, SIGINT);
    }

    Outcome run(const std::vector<std::string>& arguments) { return finish(start(arguments)); }

    fs::path write(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }

    /// A run that must be refused: exit code 2, a message that names `what`, and an older output that stays as it was.
    void expectRefused(std::vector<std::string> arguments, const std::string& what) {
        write("old.png", "the user's own");
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 2) << outcome.err;
        EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
        EXPECT_EQ(textOf(folder_ / "old.png"), "the user's own");
    }

    const support::ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path();
};

const std::vector<std::string> kSmall = {"--width", "16", "--height", "16", "--spp", "2", "--quiet"};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST_F(CommandLine, NoSuchScene) {
    expectRefused({"render", "nowhere.glb", "-o", "old.png"}, "nowhere.glb: no such file");
}

TEST_F(CommandLine, SceneIsAFolder) {
    fs::create_directories(folder_ / "folder.glb");
    expectRefused({"render", "folder.glb", "-o", "old.png"}, "folder.glb: is a folder");
}

TEST_F(CommandLine, TruncatedGlb) {
    const std::string whole = textOf(support::binaryFolder() / "assets" / "cornell.glb");
    ASSERT_GT(whole.size(), 100u);
    write("half.glb", whole.substr(0, whole.size() / 2));
    expectRefused({"render", "half.glb", "-o", "old.png"}, "half.glb");
}

TEST_F(CommandLine, EmptyScene) {
    write("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    expectRefused({"render", "empty.obj", "-o", "old.png"}, "empty.obj");
}

TEST_F(CommandLine, OnlyNanVertices) {
    write("nan.obj", "v nan nan nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expectRefused({"render", "nan.obj", "-o", "old.png"}, "nan.obj");
}

TEST_F(CommandLine, UnknownFlag) { expectRefused({"render", "cornell", "-o", "old.png", "--sp", "4"}, "--sp"); }

TEST_F(CommandLine, UnknownSubcommandIsNamed) {
    expectRefused({"rendr", "cornell", "-o", "old.png"}, "there is no subcommand 'rendr'");
    expectRefused({"render", "--spp", "many"}, "--spp");
    expectRefused({}, "subcommand is required");
}

/// As root a renamed file would take the place of /dev/null for good.
TEST_F(CommandLine, DevicesAreWrittenAndNotReplaced) {
    fs::create_symlink("/dev/null", folder_ / "null.json");
    EXPECT_EQ(run(with({"render", "cornell", "-o", "a.png", "--json", "null.json"}, kSmall)).exitCode, 0);
    EXPECT_TRUE(fs::is_symlink(folder_ / "null.json"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    fs::create_symlink("/dev/full", folder_ / "full.json");
    const Outcome full = run(with({"render", "cornell", "-o", "a.png", "--json", "full.json"}, kSmall));
    EXPECT_EQ(full.exitCode, 2) << full.err;
    EXPECT_NE(full.err.find("disk full"), std::string::npos) << full.err;
}

TEST_F(CommandLine, UnknownSettingNamesItsNeighbour) {
    expectRefused({"render", "cornell", "-o", "old.png", "--set", "widht=4"}, "did you mean width");
}

TEST_F(CommandLine, SizesOutOfRange) {
    expectRefused({"render", "cornell", "-o", "old.png", "--width", "1000000"}, "--width");
    expectRefused({"render", "cornell", "-o", "old.png", "--width", "0"}, "--width");
    expectRefused({"render", "cornell", "-o", "old.png", "--spp", "many"}, "--spp");
    expectRefused({"render", "cornell", "-o", "old.png", "--width", "65536", "--height", "65536"}, "film");
}

TEST_F(CommandLine, UnwritableOutput) {
    write("file", "not a folder");
    expectRefused({"render", "cornell", "-o", "file/out.png"}, "file/out.png");
    expectRefused({"render", "cornell", "-o", "out.gif"}, "out.gif");
}

TEST_F(CommandLine, UnknownCameraAndEnvironment) {
    expectRefused({"render", "cornell", "-o", "old.png", "--camera", "nobody"}, "nobody");
    expectRefused({"render", "cornell", "-o", "old.png", "--environment", "nowhere.hdr"}, "nowhere.hdr");
}

TEST_F(CommandLine, UnknownDeviceHasItsOwnExitCode) {
    const Outcome outcome = run({"render", "cornell", "-o", "a.png", "--device", "no such device"});
    EXPECT_EQ(outcome.exitCode, 3) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "a.png"));
}

TEST_F(CommandLine, HelpAndVersion) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--help"}, {"--version"}, {"render", "--help"}}) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exitCode, 0);
        EXPECT_FALSE(outcome.out.empty());
    }
    EXPECT_EQ(run({}).exitCode, 2);
}

TEST_F(CommandLine, RenderWritesWhatTheJsonSays) {
    const Outcome outcome = run(with({"render", "cornell", "-o", "a.exr", "--json", "-", "--validation"}, kSmall));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const nlohmann::json json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["schema"], "raylab.render/1");
    EXPECT_EQ(json["settings"]["width"], 16);
    EXPECT_EQ(json["samples"], 2);
    EXPECT_EQ(json["nonFinitePixels"], 0);
    EXPECT_EQ(json["validationMessages"], 0);
    EXPECT_GT(json["raysPerSecond"], 0.0);
    for (const char* phase : {"import", "build", "upload", "compile", "render", "total"})
        EXPECT_TRUE(json["seconds"].contains(phase));
    Metadata metadata;
    const std::vector<Layer> layers = readExrLayers(folder_ / "a.exr", &metadata);
    ASSERT_EQ(layers.size(), 3u);
    EXPECT_EQ(layers[0].bitmap.width, 16);
    const auto samples =
        std::find_if(layers.begin(), layers.end(), [](const Layer& layer) { return layer.name == "samples"; });
    ASSERT_NE(samples, layers.end());
    EXPECT_EQ(samples->bitmap.pixels[0], 2.0f);
    const auto has = [&](const char* key, const char* value) {
        return std::find(metadata.begin(), metadata.end(), std::pair<std::string, std::string>(key, value)) !=
               metadata.end();
    };
    EXPECT_TRUE(has("seed", "0") && has("spp", "2") && has("scene", "cornell"));
}

TEST_F(CommandLine, SameSeedSameBits) {
    for (const char* name : {"a.exr", "b.exr"})
        ASSERT_EQ(run(with({"render", "cornell", "-o", name, "--seed", "7"}, kSmall)).exitCode, 0);
    ASSERT_EQ(run(with({"render", "cornell", "-o", "c.exr", "--seed", "8"}, kSmall)).exitCode, 0);
    EXPECT_EQ(textOf(folder_ / "a.exr"), textOf(folder_ / "b.exr"));
    EXPECT_NE(textOf(folder_ / "a.exr"), textOf(folder_ / "c.exr"));
    EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--max-rmse", "0", "--heat", "heat.png"}).exitCode, 0);
    EXPECT_EQ(run({"compare", "a.exr", "c.exr", "--max-rmse", "0"}).exitCode, 1);
    EXPECT_EQ(run({"compare", "a.exr", "none.exr"}).exitCode, 2);
    EXPECT_TRUE(fs::exists(folder_ / "heat.png"));
}

TEST_F(CommandLine, InterruptWritesWhatIsThere) {
    const pid_t child =
        start({"render", "cornell", "-o", "a.png", "--spp", "4000000000", "--width", "64", "--height", "64"});
    interruptAfter(child, "stderr", "samples");
    const auto sent = std::chrono::steady_clock::now();
    const Outcome outcome = finish(child);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(5));
    EXPECT_TRUE(fs::exists(folder_ / "a.png"));
}

/// The second scene takes as long as the first, which is done when the signal comes.
TEST_F(CommandLine, InterruptedBenchKeepsItsRows) {
    const pid_t child = start({"bench", "cornell", "cornell", "--rays", "primary", "--no-peers", "--repeats", "200",
                               "--width", "128", "--height", "128", "--json", "a.json", "--csv", "a.csv"});
    interruptAfter(child, "stdout", "Mrays/s");
    const Outcome outcome = finish(child);
    EXPECT_EQ(outcome.exitCode, 130) << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted; what was measured before is kept (rows: 1)"), std::string::npos)
        << outcome.err;
    const nlohmann::json json = nlohmann::json::parse(textOf(folder_ / "a.json"));
    EXPECT_EQ(json["complete"], false);
    ASSERT_EQ(json["rows"].size(), 1u);
    EXPECT_GT(json["rows"][0]["mraysPerSecond"], 0.0);
    const std::string csv = textOf(folder_ / "a.csv");
    EXPECT_NE(csv.find("cornell,primary,software"), std::string::npos) << csv;
    EXPECT_NE(csv.find("# ended early"), std::string::npos) << csv;
}

TEST_F(CommandLine, InterruptedAdviceKeepsItsSteps) {
    const pid_t child = start({"advise", "cornell", "--width", "32", "--height", "32", "--depth", "2", "--target-error",
                               "0.3", "-o", "p.json", "--json", "a.json"});
    interruptAfter(child, "stderr", "integrator");  // the second setting: one step is done
    const Outcome outcome = finish(child);
    EXPECT_EQ(outcome.exitCode, 130) << outcome.err;
    const nlohmann::json json = nlohmann::json::parse(textOf(folder_ / "a.json"));
    EXPECT_EQ(json["complete"], false);
    ASSERT_GE(json["steps"].size(), 1u);
    EXPECT_EQ(json["steps"][0]["setting"], "depth");
    EXPECT_FALSE(json.contains("forecast"));
    EXPECT_NE(outcome.out.find("What it chose"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder_ / "p.json"));
}

TEST_F(CommandLine, InfoSaysWhatTheKernelNeeds) {
    const Outcome outcome = run({"info", "cornell", "--json", "-"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const nlohmann::json json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["schema"], "raylab.info/1");
    EXPECT_GE(json["triangles"], 32);  // 16 quadrilaterals at least
    std::vector<std::string> needed;
    for (const nlohmann::json& need : json["needs"])
        if (need["needed"].get<bool>()) needed.push_back(need["name"]);
    EXPECT_NE(std::find(needed.begin(), needed.end(), "emissive triangles"), needed.end());
    EXPECT_EQ(std::find(needed.begin(), needed.end(), "textures"), needed.end());
    EXPECT_EQ(std::find(needed.begin(), needed.end(), "transmission"), needed.end());
    EXPECT_GT(json["bvh"]["sah"], 0.0);
}

TEST_F(CommandLine, DevicesAreListed) {
    const Outcome outcome = run({"devices", "--json", "-"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_FALSE(nlohmann::json::parse(outcome.out)["devices"].empty());
}

}  // namespace
}  // namespace raylab
