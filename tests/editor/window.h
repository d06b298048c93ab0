#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>

#include "tests/support/paths.h"

namespace raylab::support {

/// Runs the editor in a folder of its own, on a display of its own (Xvfb), and is its user: real events come from
/// xdotool.
class WindowTest : public testing::Test {
protected:
    void SetUp() override {
        for (const char* tool : {"xvfb-run", "xdotool"})
            if (std::system((std::string("command -v ") + tool + " > /dev/null").c_str()) != 0)
                GTEST_SKIP() << tool << " is not installed: the editor's window is not tested";
        std::string name = (std::filesystem::temp_directory_path() / "raylab-editor-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override {
        if (!folder_.empty() && !HasFailure()) std::filesystem::remove_all(folder_);
    }

    void writeFile(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
    std::string readFile(const std::string& name) const {
        std::ifstream stream(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    /// Runs `raylab edit` with the arguments, with validation, and a shell script beside it that uses xdotool; returns
    /// the editor's exit code. What both print is in `log`.
    int runEditor(const std::string& arguments, const std::string& user = "") const {
        const std::string edit = "'" + program_.string() + "' edit --validation " + arguments;
        const std::string find =
            "export WINDOW=$(timeout 20 xdotool search --sync --onlyvisible --name raylab | head -n 1)\n";
        writeFile("user.sh", user);
        writeFile("both.sh",
                  (user.empty() ? edit + "\n" : edit + " & export editor=$!\n" + find + "sh ./user.sh\nwait $editor\n") +
                      "echo $? > exit-code\n");
        std::filesystem::remove(folder_ / "exit-code");
        // Each process looks for a free display from another number on, or two find the same one.
        const std::string display = std::to_string(100 + ::getpid() % 10000);
        const std::string command = "cd '" + folder_.string() + "' && XDG_CONFIG_HOME='" + folder_.string() +
                                    "' XDG_STATE_HOME='" + folder_.string() + "' timeout 120 xvfb-run -n " + display +
                                    " -a -s '-screen 0 1280x720x24' sh ./both.sh > log 2>&1";
        const int status = std::system(command.c_str());
        // What xvfb-run ends with may be its own trouble with its temporary folder.
        if (const std::string own = readFile("exit-code"); !own.empty()) return std::stoi(own);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    /// Runs a script of the editor's own commands.
    int runScript(const std::string& arguments, const std::string& script, const std::string& user = "") const {
        writeFile("script", script);
        return runEditor(arguments + " --script script", user);
    }

    std::filesystem::path folder_;
    std::filesystem::path program_ = binaryFolder() / "raylab";
};

}  // namespace raylab::support
