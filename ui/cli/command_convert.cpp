#include <iostream>

#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/scene/bounds.h"
#include "engine/scene/import.h"
#include "engine/scene/save_gltf.h"
#include "ui/cli/commands.h"
#include "ui/cli/options.h"

namespace raylab {
namespace {

struct ConvertOptions {
    std::string scene;
    std::string output;
    std::string json;
};

struct Conversion {
    Scene scene;
    std::vector<SavedFile> files;
    double importSeconds = 0.0;
    double saveSeconds = 0.0;

    size_t bytes() const {
        size_t sum = 0;
        for (const SavedFile& file : files) sum += file.bytes;
        return sum;
    }
};

/// The scene is whole in memory before anything is written, so the output may be the input.
Conversion convertScene(const ConvertOptions& options) {
    requireSavable(options.output);
    requireWritable(options.output);
    Conversion conversion;
    Stopwatch watch;
    conversion.scene = importScene(scenePath(options.scene));
    conversion.importSeconds = watch.restart();
    conversion.files = saveGltf(conversion.scene, options.output);
    conversion.saveSeconds = watch.seconds();
    return conversion;
}

nlohmann::ordered_json conversionJson(const ConvertOptions& options, const Conversion& conversion) {
    const Scene& scene = conversion.scene;
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const SavedFile& file : conversion.files)
        files.push_back({{"path", file.path.string()}, {"bytes", file.bytes}});
    return {{"schema", "raylab.convert/1"},
            {"scene", options.scene},
            {"output", options.output},
            {"triangles", triangleCount(scene).stored},
            {"quadrics", quadricCount(scene).stored},
            {"instances", scene.instances.size()},
            {"meshes", scene.meshes.size()},
            {"materials", scene.materials.size()},
            {"textures", scene.textures.size()},
            {"lights", scene.lights.size()},
            {"cameras", scene.cameras.size()},
            {"files", files},
            {"bytes", conversion.bytes()},
            {"seconds", {{"import", conversion.importSeconds}, {"save", conversion.saveSeconds}}},
            {"warnings", scene.warnings}};
}

ExitCode convert(const ConvertOptions& options) {
    const Conversion conversion = convertScene(options);
    for (const std::string& warning : conversion.scene.warnings) logWarning(warning);
    if (!options.json.empty()) writeJson(options.json, conversionJson(options, conversion));
    if (options.json != "-")
        for (const SavedFile& file : conversion.files)
            std::cout << file.path.string() << "  " << file.bytes << " bytes\n";
    return ExitCode::done;
}

}  // namespace

void addConvertCommand(CLI::App& app, Command& chosen) {
    CLI::App* command = app.add_subcommand("convert", "save a scene as glTF, without loss");
    const auto options = std::make_shared<ConvertOptions>();
    command->add_option("scene", options->scene, "glTF, GLB, OBJ, PLY or STL; or the name of a scene of raylab's own")
        ->required();
    command->add_option("-o,--output", options->output, ".glb (all in one file), or .gltf with its files beside it")
        ->required();
    command->add_option("--json", options->json, "write what was converted to a file, or - for standard output")
        ->type_name("FILE");
    command->callback([&chosen, options] { chosen = [options] { return convert(*options); }; });
}

}  // namespace raylab
