#include "ui/report/gnuplot.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "engine/core/error.h"

namespace raylab {
namespace {

/// What the child exits with where there is no such program, as a shell does.
constexpr int kNotFound = 127;
constexpr int kFailed = 126;

}  // namespace

bool runGnuplot(const std::filesystem::path& script) {
    const std::string folder = script.has_parent_path() ? script.parent_path().string() : ".";
    const std::string name = "./" + script.filename().string();
    const pid_t child = ::fork();
    if (child < 0)
        throw Error(std::string("gnuplot cannot be started: ") + std::strerror(errno), ExitCode::internalError);
    if (child == 0) {
        if (::chdir(folder.c_str()) != 0) ::_exit(kFailed);
        ::execlp("gnuplot", "gnuplot", name.c_str(), nullptr);
        ::_exit(errno == ENOENT ? kNotFound : kFailed);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == kNotFound) return false;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw Error("gnuplot failed on " + script.string());
    return true;
}

std::string gnuplotQuoted(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace raylab
