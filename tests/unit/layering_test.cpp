#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/paths.h"

namespace {
namespace fs = std::filesystem;

const fs::path kRoot = raylab::support::sourceFolder();

const std::set<std::string> kEditor = {"engine/core",   "engine/image",   "engine/scene", "engine/accel",    "engine/gpu",
                                       "engine/render", "engine/measure", "engine/measure/stability", "ui/report", "ui/editor", "ui/editor/panels",
                                       "ui/editor/model", "shaders/shared"};

/// What each folder may include besides itself; architecture.md, "Arrows point down only".
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"engine/core", {}},
    {"engine/image", {"engine/core"}},
    {"engine/accel", {"engine/core"}},
    {"engine/gpu", {"engine/core"}},
    {"engine/scene", {"engine/core", "engine/image", "shaders/shared"}},
    {"engine/render", {"engine/core", "engine/image", "engine/scene", "engine/accel", "engine/gpu", "shaders/shared"}},
    {"engine/measure",
     {"engine/core", "engine/image", "engine/scene", "engine/accel", "engine/gpu", "engine/render", "shaders/shared"}},
    {"ui/editor/model", {"engine/core", "engine/image", "engine/scene", "engine/render"}},
    {"ui/editor", kEditor},
    {"ui/editor/panels", kEditor},
    {"engine/measure/stability",
     {"engine/core", "engine/image", "engine/scene", "engine/accel", "engine/gpu", "engine/render", "engine/measure",
      "shaders/shared"}},
    {"ui/report",
     {"engine/core", "engine/image", "engine/scene", "engine/accel", "engine/gpu", "engine/render", "engine/measure",
      "engine/measure/stability"}},
    {"ui/cli",
     {"engine/core", "engine/image", "engine/scene", "engine/accel", "engine/gpu", "engine/render", "engine/measure",
      "engine/measure/stability", "ui/report", "ui/editor"}},
};

struct Include {
    fs::path file;
    std::string folder;    ///< that the file is in
    std::string included;  ///< text between the quotes or angle brackets
};

std::vector<Include> includesBelow(const fs::path& top) {
    static const std::regex pattern(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
    std::vector<Include> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / top)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".h" && extension != ".cpp") continue;
        std::ifstream stream(entry.path());
        for (std::string line; std::getline(stream, line);)
            if (std::smatch match; std::regex_search(line, match, pattern))
                found.push_back({entry.path(), fs::relative(entry.path().parent_path(), kRoot).generic_string(), match[1]});
    }
    return found;
}

bool isOurs(const std::string& included) {
    return included.rfind("engine/", 0) == 0 || included.rfind("ui/", 0) == 0 || included.rfind("shaders/", 0) == 0;
}

TEST(Layering, ArrowsPointDownOnly) {
    size_t checked = 0;
    for (const char* top : {"engine", "ui"})
        for (const Include& include : includesBelow(top)) {
            ASSERT_TRUE(kMayInclude.contains(include.folder)) << include.folder << " is in no layer: add it above";
            if (!isOurs(include.included)) continue;
            const std::string target = fs::path(include.included).parent_path().generic_string();
            ++checked;
            EXPECT_TRUE(target == include.folder || kMayInclude.at(include.folder).contains(target))
                << include.file << " includes " << include.included;
        }
    EXPECT_GT(checked, 100u);
}

TEST(Layering, OnlyTheEditorKnowsWindows) {
    for (const char* top : {"engine", "ui/report", "ui/cli", "ui/editor/model", "tests"})
        for (const Include& include : includesBelow(top))
            EXPECT_FALSE(include.included.find("imgui") != std::string::npos || include.included.find("GLFW") != std::string::npos)
                << include.file << " includes " << include.included;
}

TEST(Layering, OnlyGpuAndRenderKnowVulkan) {
    for (const Include& include : includesBelow("engine")) {
        if (include.included.rfind("vulkan", 0) != 0) continue;
        EXPECT_TRUE(include.folder == "engine/gpu" || include.folder == "engine/render") << include.file;
    }
}

TEST(Layering, SharedHeadersIncludeTheirSiblingsAlone) {
    for (const Include& include : includesBelow("shaders/shared")) {
        const bool isTypes = include.file.filename() == "types.h";
        EXPECT_TRUE(isTypes || include.included.find('/') == std::string::npos) << include.file << " includes " << include.included;
    }
}

}  // namespace
