#include "engine/core/file.h"
#include "ui/cli/commands.h"
#include "ui/cli/options.h"
#include "ui/editor/editor.h"

namespace raylab {
namespace {

struct EditOptions {
    explicit EditOptions(CLI::App& command) : settings(command) {}

    SettingOptions settings;
    std::string scene;
    std::string script;
};

ExitCode edit(const EditOptions& options) {
    EditorOptions editor;
    editor.settings = options.settings.resolve();
    if (!options.scene.empty()) {
        editor.scene = scenePath(options.scene);
        requireReadableFile(editor.scene);
    }
    editor.script = options.script;
    if (!editor.script.empty()) requireReadableFile(editor.script);
    return runEditor(editor);
}

}  // namespace

void addEditCommand(CLI::App& app, Command& chosen) {
    CLI::App* command = app.add_subcommand("edit", "a window to see, change and question a scene while it renders");
    const auto options = std::make_shared<EditOptions>(*command);
    command->add_option("scene", options->scene, "glTF, GLB, OBJ, PLY or STL; or the name of a scene of raylab's own");
    command
        ->add_option("--script", options->script, "commands to run in the window instead of a user's (docs/editor.md)")
        ->type_name("FILE");
    command->callback([&chosen, options] { chosen = [options] { return edit(*options); }; });
}

}  // namespace raylab
