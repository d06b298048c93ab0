#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "engine/core/hash.h"

namespace raylab {

/// What the build tells of its kernels: beside them, the GLSL folder and how each is compiled from it.
constexpr const char* kShaderCommandsFile = "commands.txt";

/// Keeps the .spv files of a source tree up to its GLSL while raylab runs, by the build's own commands. Threads may
/// share one.
class ShaderSources {
public:
    /// `kernels`: folder of the .spv files, which are taken to be of the sources as these are now.
    explicit ShaderSources(std::filesystem::path kernels);

    /// Why nothing can be compiled, as in an installed raylab; empty where it can.
    const std::string& missing() const { return missing_; }

    /// Compiles those of the wanted kernels (names of entry files) whose sources have changed, each file whole or as it
    /// was. Returns a number that grows when the code of a wanted one becomes another. Throws Error with file and line
    /// where one does not compile; all files are then as they were. Does nothing where sources are missing.
    uint64_t refresh(const std::function<bool(const std::string& entry)>& wanted);

    /// Of the names, sizes and times of all sources.
    Hash128 stamp() const;

private:
    using Stamps = std::map<std::filesystem::path, Hash128>;
    struct Kernel {
        std::vector<std::string> command;
        Stamps sources;       ///< that it was compiled from here; none: as the build made it
        uint64_t change = 0;  ///< of the code, counted over all kernels
    };
    struct Compiled {
        std::vector<std::byte> code;
        Stamps sources;
    };

    void readCommands(const std::filesystem::path& file);
    std::filesystem::path fileOf(const std::string& entry) const { return folder_ / (entry + ".spv"); }
    Stamps stampAll() const;
    bool isCurrent(const Kernel& kernel, const Stamps& now) const;
    static Compiled compile(const Kernel& kernel, const Stamps& now);

    std::filesystem::path folder_;  ///< of the kernels
    std::filesystem::path sources_;
    std::string missing_;
    Stamps atStart_;
    std::mutex mutex_;
    std::map<std::string, Kernel> kernels_;  ///< by entry
    uint64_t changes_ = 0;
};

}  // namespace raylab
