#pragma once

#include <string>
#include <vector>

#include "ui/editor/script.h"

namespace raylab {

/// What a check may ask for: samples, noise, divisor, phase, instances, selected, undo-steps, unsaved, file, error,
/// recovery, job, window-width, window-height, view-width, view-height, picture-contrast (standard deviation of the picture's
/// green, 0 to 127), camera-x, camera-y, camera-z, target-x, target-y, target-z, errors (lines of the log), validation,
/// samples-b, cost-a, cost-b (seconds a sample), error-a, error-b, difference (the figure of a difference picture; all
/// of these -1 where not known), wipe, compare (the mode), tracing-b, error-of-b, latency-p50, latency-p99, latency-worst
/// (milliseconds), one of inspectionNumbers(), or the name of a setting. Throws Error where there is no
/// such value.
std::string scriptValue(const std::string& name, const ScriptHost& host);

/// Compares as numbers where both are, else as texts; `operation` is one of == != < <= > >= and, of texts, contains.
/// Throws Error for another.
bool scriptCompare(const std::string& left, const std::string& operation, const std::string& right);

/// GLFW's key and modifiers of "w", "Tab" or "Ctrl+Shift+Z"; throws Error where there is none.
struct ScriptKey {
    int key = 0;
    int mods = 0;
};
ScriptKey scriptKey(const std::string& text);

}  // namespace raylab
