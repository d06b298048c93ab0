#include <iomanip>
#include <iostream>

#include "engine/core/file.h"
#include "engine/core/stopwatch.h"
#include "engine/measure/bvh_report.h"
#include "engine/measure/tree_export.h"
#include "engine/render/gpu_data.h"
#include "engine/render/lighting.h"
#include "engine/render/wavefront.h"
#include "engine/scene/bounds.h"
#include "engine/scene/import.h"
#include "engine/scene/needs.h"
#include "ui/cli/bvh_report_output.h"
#include "ui/cli/commands.h"
#include "ui/cli/options.h"

namespace raylab {
namespace {

struct InfoOptions {
    explicit InfoOptions(CLI::App& command) : settings(command) {}

    SettingOptions settings;
    std::string scene;
    std::string json;
    std::string nodes;
    bool bvh = false;
};

struct Info {
    Scene scene;
    Bounds bounds;
    PrimitiveCount triangles, quadrics;
    SceneNeeds needs;
    BvhReport bvh;
    size_t sceneBytes = 0;
    size_t pathBytes = 0;  ///< of a path's state under --schedule wavefront
    double importSeconds = 0.0;
};

/// What the scene takes on the device apart from the traversal's structures, and what a path under way would.
void measureMemory(Info& info) {
    const Scene& scene = info.scene;
    const float radius = 0.5f * glm::length(info.bounds.hi - info.bounds.lo);
    const GeometryData geometry = packGeometry(scene);
    MaterialTables materials = packMaterials(scene);
    const LightTables lights = packLights(scene, radius, materials);
    const auto bytes = [](const auto& data) { return std::as_bytes(std::span(data)).size(); };
    info.pathBytes = pathBytes(info.needs.mask, !lights.nodes.empty());
    info.sceneBytes =
        bytes(geometry.instances) + bytes(geometry.triangles) + bytes(geometry.vertices) + bytes(materials.materials) +
           bytes(materials.textures) + bytes(materials.texels) + bytes(lights.emissive) + bytes(lights.punctual) +
           bytes(lights.nodes) + bytes(lights.trails) + bytes(lights.environment) + bytes(lights.environmentAlias);
}

Info gather(const InfoOptions& options) {
    Info info;
    const RenderSettings settings = options.settings.resolve();
    const Stopwatch watch;
    info.scene = importScene(scenePath(options.scene));
    info.importSeconds = watch.seconds();
    const TraceConfig config = traceConfig(settings, info.scene);
    settleEnvironment(info.scene, {});
    info.bounds = sceneBounds(info.scene);
    info.triangles = triangleCount(info.scene);
    info.quadrics = quadricCount(info.scene);
    info.needs = analyseNeeds(info.scene, treePlanConfig(config));
    info.bvh = measureBvh(info.scene, config, options.bvh ? BvhDetail::full : BvhDetail::quick);
    measureMemory(info);
    return info;
}

nlohmann::ordered_json infoJson(const InfoOptions& options, const Info& info) {
    nlohmann::ordered_json needs = nlohmann::ordered_json::array(), cameras = nlohmann::ordered_json::array();
    for (const Need& need : info.needs.needs)
        needs.push_back({{"name", need.name}, {"needed", need.needed}, {"reason", need.reason}});
    for (const Camera& camera : info.scene.cameras) cameras.push_back(camera.name);
    const auto vec = [](glm::vec3 v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
    return {{"schema", "raylab.info/1"},
            {"scene", options.scene},
            {"triangles", info.triangles.stored},
            {"instancedTriangles", info.triangles.instanced},
            {"quadrics", info.quadrics.stored},
            {"instancedQuadrics", info.quadrics.instanced},
            {"instances", info.scene.instances.size()},
            {"meshes", info.scene.meshes.size()},
            {"materials", info.scene.materials.size()},
            {"textures", info.scene.textures.size()},
            {"lights", info.scene.lights.size()},
            {"cameras", cameras},
            {"bounds", {{"lo", vec(info.bounds.lo)}, {"hi", vec(info.bounds.hi)}}},
            {"needs", needs},
            {"memoryBytes", info.sceneBytes + info.bvh.bytes()},
            {"pathBytes", info.pathBytes},
            {"bvh", bvhReportJson(info.bvh)},
            {"seconds", {{"import", info.importSeconds}}},
            {"warnings", info.scene.warnings}};
}

void printInfo(const InfoOptions& options, const Info& info) {
    const Scene& s = info.scene;
    const auto mebibytes = [](size_t bytes) { return static_cast<double>(bytes) / (1 << 20); };
    std::cout << std::fixed << std::setprecision(1) << options.scene << "  (import " << info.importSeconds << " s)\n"
              << "  triangles   " << info.triangles.stored << " stored, " << info.triangles.instanced << " shown\n"
              << "  quadrics    " << info.quadrics.stored << " stored, " << info.quadrics.instanced << " shown\n"
              << "  meshes      " << s.meshes.size() << " in " << s.instances.size() << " instances\n"
              << "  materials   " << s.materials.size() << ", textures " << s.textures.size() << "\n"
              << "  lights      " << s.lights.size() << " punctual\n  cameras     " << s.cameras.size();
    for (const Camera& camera : s.cameras) std::cout << "  '" << camera.name << "'";
    std::cout << std::setprecision(3) << "\n  bounds      (" << info.bounds.lo.x << ", " << info.bounds.lo.y << ", " << info.bounds.lo.z
              << ") to (" << info.bounds.hi.x << ", " << info.bounds.hi.y << ", " << info.bounds.hi.z << ")\n"
              << std::setprecision(1) << "  memory      " << mebibytes(info.sceneBytes) << " MiB scene + " << mebibytes(info.bvh.bytes())
              << " MiB BVH; " << info.pathBytes << " bytes a path under --schedule wavefront\n"
              << bvhReportLine(info.bvh) << "\n";
    if (options.bvh) std::cout << bvhReportText(info.bvh);
    std::cout << "\nThe kernel for this scene contains\n";
    for (const Need& need : info.needs.needs)
        std::cout << "  " << (need.needed ? "[x] " : "[ ] ") << std::left << std::setw(20) << need.name << need.reason << "\n";
    if (!s.warnings.empty()) std::cout << "\nWarnings\n";
    for (const std::string& warning : s.warnings) std::cout << "  " << warning << "\n";
}

void writeNodes(const InfoOptions& options, const Info& info) {
    const std::string csv = nodeListCsv(inspectTrees(info.scene, traceConfig(options.settings.resolve(), info.scene)));
    writeFileAtomically(options.nodes, std::as_bytes(std::span(csv)));
}

ExitCode showInfo(const InfoOptions& options) {
    if (!options.nodes.empty()) requireWritable(options.nodes);
    const Info info = gather(options);
    if (!options.nodes.empty()) writeNodes(options, info);
    if (!options.json.empty()) writeJson(options.json, infoJson(options, info));
    if (options.json != "-") printInfo(options, info);
    return ExitCode::done;
}

}  // namespace

void addInfoCommand(CLI::App& app, Command& chosen) {
    CLI::App* command = app.add_subcommand("info", "contents of a scene, its BVH, and what its kernel needs");
    const auto options = std::make_shared<InfoOptions>(*command);
    command->add_option("scene", options->scene, "glTF, GLB, OBJ, PLY or STL; or the name of a scene of raylab's own")->required();
    command->add_flag("--bvh", options->bvh, "measure the trees thoroughly: end-point overlap, histograms, times; takes seconds");
    command->add_option("--nodes", options->nodes, "write every node of the trees to a CSV file")->type_name("FILE");
    command->add_option("--json", options->json, "write all of it to a file, or - for standard output")->type_name("FILE");
    command->callback([&chosen, options] { chosen = [options] { return showInfo(*options); }; });
}

}  // namespace raylab
