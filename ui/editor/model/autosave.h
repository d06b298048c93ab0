#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "ui/editor/model/document_file.h"

namespace raylab::editor {

/// $XDG_STATE_HOME/raylab/autosave, or ~/.local/state/raylab/autosave. Throws Error where neither variable is set.
std::filesystem::path autosaveFolder();

/// Keeps a copy of an unsaved document on disk, written beside the interface: a copy of a scene shares what is large.
///
/// A session has files of one name in the folder: its copy, what the copy is of, and a lock file with its process
/// number that it holds locked (flock). The kernel lets go of the lock when the process ends, however it ends, so an
/// unlocked one with a copy is what a crash has left.
class Autosave {
public:
    using Clock = std::chrono::steady_clock;

    /// Creates the folder and takes the lock. Throws Error where it cannot.
    Autosave(const std::filesystem::path& folder, std::chrono::seconds interval);
    ~Autosave();
    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;

    /// Call it often: starts a copy where the document is unsaved, has changed since the last copy, and the interval is
    /// over; removes the copy of a document that is saved by now. True where a copy was started.
    bool update(const Document& document, const std::optional<Camera>& view, Clock::time_point now = Clock::now());
    /// Waits for a copy that is being written.
    void wait();
    /// Why the last copy failed, once; empty where it did not.
    std::string takeProblem();
    /// There is nothing to recover any more: saved, or thrown away by the user's wish.
    void discard();

private:
    void collect();

    int lock_ = -1;               ///< set together with base_, which is declared after it therefore
    std::filesystem::path base_;  ///< folder and name of the session, without an extension
    std::chrono::seconds interval_;
    Clock::time_point lastCopy_;
    std::optional<uint64_t> copiedRevision_;
    std::future<void> writing_;
    std::string problem_;
};

/// A copy that a crash has left behind.
struct Recoverable {
    std::filesystem::path base;      ///< as in Autosave
    std::filesystem::path original;  ///< of which it is a copy; empty: of a scene that was never saved
    std::filesystem::file_time_type time;
};

/// The newest first. Leftovers without a copy are removed.
std::vector<Recoverable> findRecoverable(const std::filesystem::path& folder);

/// The document, unsaved, with the original's name. Throws Error where the copy cannot be read.
OpenedDocument recover(const Recoverable& copy);
void discard(const Recoverable& copy);

}  // namespace raylab::editor
