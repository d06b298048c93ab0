#include "engine/core/process.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "engine/core/error.h"

namespace raylab {
namespace {

/// The two ends of a pipe, closed at the latest with this.
class Pipe {
public:
    Pipe() {
        if (::pipe(ends_.data()) != 0) throw Error(std::string("no pipe: ") + std::strerror(errno));
    }
    ~Pipe() {
        closeEnd(0);
        closeEnd(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    int end(size_t i) const { return ends_[i]; }
    void closeEnd(size_t i) {
        if (ends_[i] >= 0) ::close(ends_[i]);
        ends_[i] = -1;
    }
    std::string readAll() const {
        std::string text;
        std::array<char, 4096> piece{};
        while (true) {
            const ssize_t count = ::read(ends_[0], piece.data(), piece.size());
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return text;
            text.append(piece.data(), static_cast<size_t>(count));
        }
    }

private:
    std::array<int, 2> ends_{-1, -1};
};

pid_t start(const std::vector<std::string>& words, const Pipe& pipe) {
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addclose(&actions, pipe.end(0));
    ::posix_spawn_file_actions_adddup2(&actions, pipe.end(1), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, pipe.end(1), STDERR_FILENO);
    ::posix_spawn_file_actions_addclose(&actions, pipe.end(1));
    pid_t child = 0;
    const int failed = ::posix_spawnp(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw Error(words[0] + ": cannot be run (" + std::strerror(failed) + "); is it installed?");
    return child;
}

}  // namespace

ProcessResult runProcess(const std::vector<std::string>& words) {
    Pipe pipe;
    const pid_t child = start(words, pipe);
    pipe.closeEnd(1);
    ProcessResult result;
    result.output = pipe.readAll();
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

}  // namespace raylab
