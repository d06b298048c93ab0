#include "engine/gpu/shader_sources.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/process.h"

namespace raylab {
namespace fs = std::filesystem;
namespace {

/// A folder that is removed with what is in it.
class ScratchFolder {
public:
    ScratchFolder() {
        std::string name = (fs::temp_directory_path() / "raylab-shaders-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw Error(name + ": cannot be created (" + std::strerror(errno) + "); is the disk full?");
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

/// Of a file's size and time; another one where it is gone.
Hash128 stampOf(const fs::path& file) {
    std::error_code gone;
    const auto size = static_cast<int64_t>(fs::file_size(file, gone));
    const int64_t time = fs::last_write_time(file, gone).time_since_epoch().count();
    const int64_t values[] = {size, time};
    return hashItems(std::span<const int64_t>(values));
}

/// A rule of make, with the blanks within names as they are.
std::string readRule(const fs::path& depfile) {
    std::ifstream stream(depfile);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    for (size_t at = text.find("\\ "); at != std::string::npos; at = text.find("\\ ", at)) text.erase(at, 1);
    return text;
}

/// The compiler's complaints, "FILE:LINE: what is wrong" each, without its own words around them.
std::string complaints(const std::string& output) {
    std::istringstream stream(output);
    std::string text;
    for (std::string line; std::getline(stream, line);) {
        constexpr std::string_view kMark = "ERROR: ";
        if (!line.starts_with(kMark) || line.find("compilation errors") != std::string::npos) continue;
        text += (text.empty() ? "" : "\n") + line.substr(kMark.size());
    }
    return text.empty() ? output : text;
}

std::vector<std::string> splitAtTabs(const std::string& line) {
    std::vector<std::string> words;
    std::istringstream stream(line);
    for (std::string word; std::getline(stream, word, '\t');) words.push_back(word);
    return words;
}

}  // namespace

ShaderSources::ShaderSources(fs::path kernels) : folder_(std::move(kernels)) {
    const fs::path file = folder_ / kShaderCommandsFile;
    if (!fs::exists(file))
        missing_ = "this raylab came without its shaders' sources: there is no " + file.string();
    else
        readCommands(file);
    if (missing_.empty() && !fs::is_directory(sources_))
        missing_ = sources_.string() + ": the shaders' sources are no longer there";
    if (missing_.empty()) atStart_ = stampAll();
}

void ShaderSources::readCommands(const fs::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    sources_ = line;
    while (std::getline(stream, line)) {
        std::vector<std::string> words = splitAtTabs(line);
        if (words.size() < 2) throw Error(file.string() + ": is damaged; build raylab anew");
        const std::string entry = words.front();
        words.erase(words.begin());
        kernels_[entry].command = std::move(words);
    }
}

ShaderSources::Stamps ShaderSources::stampAll() const {
    Stamps stamps;
    std::error_code code;
    for (fs::recursive_directory_iterator at(sources_, code), end; !code && at != end; at.increment(code))
        if (at->is_regular_file(code)) stamps[at->path()] = stampOf(at->path());
    return stamps;
}

Hash128 ShaderSources::stamp() const {
    Hash128 all;
    for (const auto& [file, stamp] : stampAll()) {
        all = hashItems(std::span<const char>(file.native()), all);
        all = hashItems(std::span(&stamp, 1), all);
    }
    return all;
}

bool ShaderSources::isCurrent(const Kernel& kernel, const Stamps& now) const {
    if (kernel.sources.empty()) return now == atStart_;
    return std::ranges::all_of(kernel.sources,
                               [](const auto& source) { return stampOf(source.first) == source.second; });
}

/// Stamps are older than the text that is compiled, so that no change is missed.
ShaderSources::Compiled ShaderSources::compile(const Kernel& kernel, const Stamps& now) {
    const ScratchFolder scratch;
    const fs::path output = scratch.path() / "kernel.spv", depfile = scratch.path() / "depfile";
    std::vector<std::string> words = kernel.command;
    words.insert(words.end(), {"-o", output.string(), "--depfile", depfile.string()});
    const ProcessResult result = runProcess(words);
    if (result.exitCode != 0) throw Error(complaints(result.output));
    Compiled compiled{readFile(output), {}};
    const std::string rule = readRule(depfile);
    for (const auto& [file, stamp] : now)
        if (rule.find(file.string()) != std::string::npos) compiled.sources[file] = stamp;
    return compiled;
}

uint64_t ShaderSources::refresh(const std::function<bool(const std::string&)>& wanted) {
    const std::lock_guard lock(mutex_);
    if (!missing_.empty()) return 0;
    const Stamps now = stampAll();
    std::map<std::string, Compiled> fresh;
    for (const auto& [entry, kernel] : kernels_)
        if (wanted(entry) && !isCurrent(kernel, now)) fresh[entry] = compile(kernel, now);
    for (auto& [entry, compiled] : fresh) {
        Kernel& kernel = kernels_[entry];
        if (compiled.code != readFile(fileOf(entry))) {
            writeFileAtomically(fileOf(entry), compiled.code);
            kernel.change = ++changes_;
        }
        kernel.sources = std::move(compiled.sources);
    }
    uint64_t newest = 0;
    for (const auto& [entry, kernel] : kernels_)
        if (wanted(entry)) newest = std::max(newest, kernel.change);
    return newest;
}

}  // namespace raylab
