#pragma once

#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "engine/core/log.h"

namespace raylab {

struct LogLine {
    LogLevel level;
    std::string text;
};

/// The last lines of the log, from all threads, while it lives.
class EditorLog {
public:
    EditorLog();
    ~EditorLog();
    EditorLog(const EditorLog&) = delete;
    EditorLog& operator=(const EditorLog&) = delete;

    std::vector<LogLine> lines() const;
    void clear();
    /// Counts lines that were ever logged.
    size_t count() const;

private:
    mutable std::mutex mutex_;
    std::deque<LogLine> lines_;
    size_t count_ = 0;
};

}  // namespace raylab
