#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>

#include "engine/core/error.h"

namespace raylab {

/// What main runs after parsing: set by the subcommand that was named.
using Command = std::function<ExitCode()>;

/// Each adds its subcommand to `app`; when the user names it, `chosen` becomes the thing to run.
void addRenderCommand(CLI::App& app, Command& chosen);
void addInfoCommand(CLI::App& app, Command& chosen);
void addDevicesCommand(CLI::App& app, Command& chosen);
void addCompareCommand(CLI::App& app, Command& chosen);
void addBenchCommand(CLI::App& app, Command& chosen);
void addCompareTracersCommand(CLI::App& app, Command& chosen);
void addCountCommand(CLI::App& app, Command& chosen);
void addConvertCommand(CLI::App& app, Command& chosen);
void addEditCommand(CLI::App& app, Command& chosen);
void addStabilityCommand(CLI::App& app, Command& chosen);
void addChartCommand(CLI::App& app, Command& chosen);
void addMergeCommand(CLI::App& app, Command& chosen);
void addAdviseCommand(CLI::App& app, Command& chosen);

}  // namespace raylab
