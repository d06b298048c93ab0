#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"

namespace raylab {

using Json = nlohmann::json;

/// Runs raylab in a folder of its own, with folders of its own for configuration and cache but for kernels.
class ProgramTest : public testing::Test {
protected:
    /// Specialised kernels, which their content names, are kept from test to test: they take a second each.
    ProgramTest() {
        const std::filesystem::path kernels = support::binaryFolder() / "test-cache/kernels";
        std::filesystem::create_directories(kernels);
        std::filesystem::create_directories(folder_ / "raylab");
        std::filesystem::create_directory_symlink(kernels, folder_ / "raylab/kernels");
    }
    /// Returns the exit code; what was printed is in `out` and `err` of the folder.
    int runProgram(const std::string& arguments) const {
        const std::string folder = "'" + folder_.string() + "'";
        const int status = std::system(("cd " + folder + " && XDG_CONFIG_HOME=" + folder + " XDG_CACHE_HOME=" + folder +
                                        " '" + (support::binaryFolder() / "raylab").string() + "' " + arguments + " > out 2> err")
                                           .c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string text(const std::string& name) const {
        std::ifstream stream(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    Json json(const std::string& name) const { return Json::parse(text(name)); }
    void writeText(const std::string& name, const std::string& content) const {
        std::ofstream(folder_ / name, std::ios::binary) << content;
    }
    /// With exit code 2 and `what` among the message.
    void expectProgramRefuses(const std::string& arguments, const std::string& what) const {
        EXPECT_EQ(runProgram(arguments), 2) << arguments;
        EXPECT_NE(text("err").find(what), std::string::npos) << text("err");
    }

    const support::ScratchFolder scratch_;
    const std::filesystem::path folder_ = scratch_.path();
};

}  // namespace raylab
