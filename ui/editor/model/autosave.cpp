#include "ui/editor/model/autosave.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/scene/save_gltf.h"
#include "ui/editor/model/project_file.h"

namespace raylab::editor {
namespace {

namespace fs = std::filesystem;

fs::path withSuffix(const fs::path& base, const char* suffix) { return base.string() + suffix; }
fs::path lockOf(const fs::path& base) { return withSuffix(base, ".lock"); }
fs::path sceneOf(const fs::path& base) { return withSuffix(base, ".glb"); }
fs::path originalOf(const fs::path& base) { return withSuffix(base, ".original"); }

/// Opens and locks; -1 where another process holds the lock.
int tryLock(const fs::path& file) {
    const int handle = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (handle < 0) throw Error(file.string() + ": cannot be opened (" + std::strerror(errno) + "); check the folder");
    if (::flock(handle, LOCK_EX | LOCK_NB) == 0) return handle;
    ::close(handle);
    return -1;
}

/// A name that no other session has: process numbers come back, and one process may run several sessions.
fs::path claimName(const fs::path& folder, int& lock) {
    std::error_code code;
    fs::create_directories(folder, code);
    if (code) throw Error(folder.string() + ": cannot be made (" + code.message() + "); there will be no autosave");
    for (int i = 0;; ++i) {
        const fs::path base = folder / (std::to_string(::getpid()) + "-" + std::to_string(i));
        if (fs::exists(sceneOf(base))) continue;
        lock = tryLock(lockOf(base));
        if (lock >= 0) return base;
    }
}

/// All that belongs to a session, its lock last.
void removeFiles(const fs::path& base, bool withLock) {
    std::error_code code;
    const fs::path lock = lockOf(base);
    const std::string start = base.filename().string() + ".";
    std::vector<fs::path> mine;
    for (const fs::directory_entry& entry : fs::directory_iterator(base.parent_path(), code))
        if (entry.path().filename().string().starts_with(start) && entry.path() != lock) mine.push_back(entry.path());
    for (const fs::path& file : mine) fs::remove(file, code);
    if (withLock) fs::remove(lock, code);
}

/// The scene comes last: what it is of is known then.
void writeCopy(const Scene& scene, const Project& project, const fs::path& original, const fs::path& base) {
    writeProject(projectFile(sceneOf(base)), project);
    const std::string name = original.empty() ? "" : fs::absolute(original).string();
    writeFileAtomically(originalOf(base), std::as_bytes(std::span(name)));
    saveGltf(scene, sceneOf(base));
}

std::string textOf(const fs::path& file) {
    if (!fs::exists(file)) return {};
    const std::vector<std::byte> bytes = readFile(file);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

fs::path autosaveFolder() {
    if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/')
        return fs::path(state) / "raylab" / "autosave";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return fs::path(home) / ".local" / "state" / "raylab" / "autosave";
    throw Error("neither XDG_STATE_HOME nor HOME is set; set one of them for autosave");
}

Autosave::Autosave(const fs::path& folder, std::chrono::seconds interval)
    : base_(claimName(folder, lock_)), interval_(interval), lastCopy_(Clock::now()) {
    const std::string pid = std::to_string(::getpid()) + "\n";
    if (::write(lock_, pid.data(), pid.size()) < 0) problem_ = lockOf(base_).string() + ": " + std::strerror(errno);
}

Autosave::~Autosave() {
    wait();
    if (!fs::exists(sceneOf(base_))) removeFiles(base_, true);
    ::close(lock_);
}

bool Autosave::update(const Document& document, const std::optional<Camera>& view, Clock::time_point now) {
    if (writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    collect();
    if (!document.isUnsaved()) {
        if (copiedRevision_) discard();
        return false;
    }
    if (copiedRevision_ == document.revision() || now - lastCopy_ < interval_) return false;
    lastCopy_ = now;
    copiedRevision_ = document.revision();
    const Project project{document.settings(), view, document.hidden(), {}};
    writing_ = std::async(std::launch::async, [scene = document.scene(), project, original = document.file(),
                                               base = base_] { writeCopy(scene, project, original, base); });
    return true;
}

void Autosave::collect() {
    if (!writing_.valid()) return;
    try {
        writing_.get();
    } catch (const std::exception& error) {
        problem_ = std::string("autosave failed: ") + error.what();
    }
}

void Autosave::wait() { collect(); }

std::string Autosave::takeProblem() { return std::exchange(problem_, {}); }

void Autosave::discard() {
    wait();
    removeFiles(base_, false);
    copiedRevision_.reset();
}

std::vector<Recoverable> findRecoverable(const fs::path& folder) {
    std::error_code code;
    std::vector<fs::path> bases;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
        if (entry.path().extension() == ".lock") bases.push_back(entry.path().parent_path() / entry.path().stem());
    std::vector<Recoverable> found;
    for (const fs::path& base : bases) {
        const int lock = tryLock(lockOf(base));
        if (lock < 0) continue;  // its session lives
        if (fs::exists(sceneOf(base)))
            found.push_back({base, textOf(originalOf(base)), fs::last_write_time(sceneOf(base))});
        else
            removeFiles(base, true);
        ::close(lock);
    }
    std::sort(found.begin(), found.end(), [](const Recoverable& a, const Recoverable& b) { return a.time > b.time; });
    return found;
}

OpenedDocument recover(const Recoverable& copy) {
    OpenedDocument opened = openDocument(sceneOf(copy.base));
    opened.document.markRecovered(copy.original);
    return opened;
}

void discard(const Recoverable& copy) { removeFiles(copy.base, true); }

}  // namespace raylab::editor
