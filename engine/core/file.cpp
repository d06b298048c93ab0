#include "engine/core/file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "engine/core/error.h"

namespace raylab {
namespace fs = std::filesystem;

void requireReadableFile(const fs::path& path) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) throw Error(path.string() + ": no such file; check the spelling and the folder");
    if (fs::is_directory(status)) throw Error(path.string() + ": is a folder; name a file in it");
    if (::access(path.c_str(), R_OK) != 0)
        throw Error(path.string() + ": cannot be read (" + std::strerror(errno) + "); check its permissions");
}

std::vector<std::byte> readFile(const fs::path& path) {
    requireReadableFile(path);
    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
    if (size < 0) throw Error(path.string() + ": cannot be read");
    std::vector<std::byte> bytes(static_cast<size_t>(size));
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(bytes.data()), size);
    if (!stream) throw Error(path.string() + ": reading failed half-way");
    return bytes;
}

namespace {

fs::path temporaryBeside(const fs::path& path) {
    return path.parent_path() / ("." + path.filename().string() + "." + std::to_string(::getpid()) + ".tmp");
}

fs::path folderOf(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// A device or a pipe, as /dev/null is: what a renamed file would take the place of for good.
bool isSpecial(const fs::path& path) {
    std::error_code code;
    return fs::exists(path, code) && !fs::is_regular_file(path, code) && !fs::is_directory(path, code);
}

[[noreturn]] void refuseToWrite(const fs::path& path, const std::string& why) {
    throw Error(path.string() + ": cannot be written (" + why + "); choose another folder with -o");
}

}  // namespace

void requireWritable(const fs::path& path) {
    std::error_code code;
    if (path.filename().empty() || fs::is_directory(path, code))
        throw Error(path.string() + ": is a folder; name a file to write");
    if (isSpecial(path)) return;
    fs::create_directories(folderOf(path), code);
    if (code) refuseToWrite(path, code.message());
    const fs::path probe = temporaryBeside(path);
    std::ofstream stream(probe, std::ios::binary);
    if (!stream) refuseToWrite(path, std::strerror(errno));
    stream.close();
    fs::remove(probe, code);
}

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    if (isSpecial(path)) return write(path);
    std::error_code code;
    fs::create_directories(folderOf(path), code);
    const fs::path temporary = temporaryBeside(path);
    try {
        write(temporary);
        fs::rename(temporary, path);
    } catch (const fs::filesystem_error& error) {
        fs::remove(temporary, code);
        throw Error(path.string() + ": cannot be written (" + error.code().message() + ")");
    } catch (...) {
        fs::remove(temporary, code);
        throw;
    }
}

void writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
    writeFileAtomically(path, [&](const fs::path& temporary) {
        std::ofstream stream(temporary, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        stream.close();
        if (!stream)
            throw Error(path.string() + ": cannot be written (" + std::strerror(errno) +
                        "); is the disk full or the folder read-only?");
    });
}

fs::path executableFolder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

fs::path dataFolder(const std::string& name) {
    const fs::path here = executableFolder();
    for (const fs::path& candidate : {here / name, here / ".." / name, here / ".." / "share" / "raylab" / name})
        if (fs::is_directory(candidate)) return fs::canonical(candidate);
    throw Error("the folder '" + name + "' is neither beside " + here.string() + " nor in ../share/raylab; reinstall raylab",
                ExitCode::internalError);
}

}  // namespace raylab
