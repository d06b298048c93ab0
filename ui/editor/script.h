#pragma once

#include <algorithm>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/stopwatch.h"
#include "ui/editor/context.h"
#include "ui/editor/imgui_backend.h"
#include "ui/editor/latency.h"

namespace raylab {

/// What a script may do to the window, beside what panels may do.
struct ScriptHost {
    EditorContext& context;
    Window& window;
    ImGuiBackend& imgui;
    LatencyRecorder& latency;
    std::optional<PointerOverride>& pointer;
    std::function<void(const std::filesystem::path&)> screenshot;  ///< of the whole window, with the next frame
    std::function<bool()> isIdle;                                  ///< nothing is read, prepared or rendered
};

/// A line of a script.
struct ScriptLine {
    int number = 0;
    std::vector<std::string> words;
};

/// Commands for the editor, a line each, run against the real window: docs/editor.md lists them. Each takes at least a
/// frame, so that the interface sees what a user would do, one thing after another.
class Script {
public:
    /// Throws Error, with file and line, for a command that does not exist.
    explicit Script(const std::filesystem::path& path);

    /// Goes on by a step; to be called once a frame before the interface is drawn. False where the script is over.
    /// Throws Error (exit code 1), with file and line, where a check fails or waiting takes too long.
    bool step(ScriptHost& host);
    /// For how long no step does anything: what is left of `wait SECONDS`, else 0.
    double restSeconds() const { return rest_ ? std::max(*rest_ - sinceStep_.seconds(), 0.0) : 0.0; }

private:
    /// True where it is done.
    using Step = std::function<bool(ScriptHost&)>;

    void expand(const ScriptLine& line);
    void expandPointer(const ScriptLine& line);
    void expandKey(const ScriptLine& line);
    void expandWait(const ScriptLine& line);
    void expandOther(const ScriptLine& line);
    /// The fourth word of a comparison, or the value that was remembered under the second.
    std::string operand(const std::vector<std::string>& words) const;
    void add(Step step) { steps_.push_back(std::move(step)); }
    [[noreturn]] void fail(const std::string& message) const;

    std::filesystem::path path_;
    std::deque<ScriptLine> lines_;
    ScriptLine current_;
    std::map<std::string, std::string> remembered_;
    std::deque<Step> steps_;  ///< of the current line
    Stopwatch sinceStep_;
    bool isFirstFrame_ = true;  ///< of the step at the front
    std::optional<double> rest_;  ///< that the current line asks for
    double timeout_ = 120.0;
    int frames_ = 0;
};

}  // namespace raylab
