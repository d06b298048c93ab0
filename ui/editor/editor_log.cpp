#include "ui/editor/editor_log.h"

namespace raylab {
namespace {

constexpr size_t kMostLines = 2000;

}  // namespace

EditorLog::EditorLog() {
    setLogListener([this](LogLevel level, const std::string& text) {
        const std::lock_guard lock(mutex_);
        lines_.push_back({level, text});
        if (lines_.size() > kMostLines) lines_.pop_front();
        ++count_;
    });
}

EditorLog::~EditorLog() { setLogListener({}); }

std::vector<LogLine> EditorLog::lines() const {
    const std::lock_guard lock(mutex_);
    return {lines_.begin(), lines_.end()};
}

void EditorLog::clear() {
    const std::lock_guard lock(mutex_);
    lines_.clear();
}

size_t EditorLog::count() const {
    const std::lock_guard lock(mutex_);
    return count_;
}

}  // namespace raylab
