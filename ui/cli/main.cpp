#include <exception>
#include <new>

#include "engine/core/log.h"
#include "ui/cli/commands.h"

namespace raylab {
namespace {

ExitCode runCommandLine(int argc, char** argv) {
    CLI::App app{"raylab: a laboratory for ray tracing"};
    app.set_version_flag("--version", "raylab " RAYLAB_VERSION);
    app.require_subcommand(1);
    app.failure_message(CLI::FailureMessage::help);
    Command chosen;
    addRenderCommand(app, chosen);
    addInfoCommand(app, chosen);
    addDevicesCommand(app, chosen);
    addCompareCommand(app, chosen);
    addBenchCommand(app, chosen);
    addCompareTracersCommand(app, chosen);
    addCountCommand(app, chosen);
    addConvertCommand(app, chosen);
    addEditCommand(app, chosen);
    addStabilityCommand(app, chosen);
    addChartCommand(app, chosen);
    addMergeCommand(app, chosen);
    addAdviseCommand(app, chosen);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            app.exit(error);
            return ExitCode::done;
        }
        const bool isUnknown = argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty();
        logError((isUnknown ? "there is no subcommand '" + std::string(argv[1]) + "'" : std::string(error.what())) +
                 "\nraylab --help and raylab SUBCOMMAND --help list what there is");
        return ExitCode::badInput;
    }
    return chosen();
}

}  // namespace
}  // namespace raylab

int main(int argc, char** argv) {
    using namespace raylab;
    ExitCode code = ExitCode::internalError;
    try {
        code = runCommandLine(argc, argv);
    } catch (const Error& error) {
        logError(error.what());
        code = error.exitCode();
    } catch (const std::bad_alloc&) {
        logError("out of memory; use a smaller scene or image");
        code = ExitCode::badInput;
    } catch (const std::exception& error) {
        logError(std::string("internal: ") + error.what());
    }
    return static_cast<int>(code);
}
