#include <iomanip>
#include <iostream>

#include "engine/accel/quality.h"
#include "engine/core/file.h"
#include "engine/core/stopwatch.h"
#include "engine/render/gpu_data.h"
#include "engine/render/lighting.h"
#include "engine/render/trace_data.h"
#include "engine/scene/bounds.h"
#include "engine/scene/import.h"
#include "engine/scene/needs.h"
#include "ui/cli/commands.h"
#include "ui/cli/options.h"

namespace raylab {
namespace {

struct InfoOptions {
    std::string scene;
    std::string json;
};

/// Figures of all trees of a scene together.
struct BvhFigures {
    double sah = 0.0;  ///< of the walk through the upper tree and the trees below it
    double epo = 0.0;  ///< of the tree with the most triangles
    int depth = 0;
    size_t nodes = 0;
    size_t trees = 0;
    double buildMs = 0.0;
    size_t bytes = 0;
    size_t skipped = 0;
};

struct Info {
    Scene scene;
    Bounds bounds;
    TriangleCount triangles;
    SceneNeeds needs;
    BvhFigures bvh;
    size_t sceneBytes = 0;
    double importSeconds = 0.0;
};

double halfArea(const Aabb& box) { return box.empty() ? 0.0 : static_cast<double>(box.halfArea()); }

/// The cost of the upper tree with each leaf's cost replaced by that of the tree below it.
double combinedSah(const TraceData& data) {
    if (data.trees.empty()) return 0.0;
    if (data.upper.nodes.empty()) return measureQuality(data.trees[0].bvh).sah;
    const double rootArea = halfArea(data.upper.nodes[0].bounds);
    double inner = 0.0, leaves = 0.0;
    for (const BvhNode& node : data.upper.nodes) {
        const double share = rootArea > 0.0 ? halfArea(node.bounds) / rootArea : 0.0;
        if (!node.isLeaf()) {
            inner += share;
            continue;
        }
        const uint32_t root = data.instances[node.first].root;
        for (const TriangleTree& tree : data.trees)
            if (tree.root == root) leaves += share * measureQuality(tree.bvh).sah;
    }
    return inner + leaves;
}

/// End-point overlap of one tree, over the vertices of its triangles as the tree holds them.
double treeEpo(const TraceData& data, const TriangleTree& tree) {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles(tree.bvh.order.size() + tree.bvh.skipped, glm::uvec3(0));
    for (uint32_t slot = 0; slot < tree.triangleCount; ++slot) {
        const shared::TraceTriangle& t = data.triangles[tree.firstTriangle + slot];
        const auto base = static_cast<uint32_t>(positions.size());
        positions.insert(positions.end(), {t.p0, t.p1, t.p2});
        triangles[tree.bvh.order[slot]] = {base, base + 1, base + 2};
    }
    return measureEpo(tree.bvh, positions, triangles);
}

BvhFigures measureBvh(const Scene& scene) {
    BvhFigures figures;
    Stopwatch watch;
    const TraceData data = buildTraceData(scene, {});
    figures.buildMs = watch.seconds() * 1e3;
    figures.sah = combinedSah(data);
    const TriangleTree* largest = nullptr;
    for (const TriangleTree& tree : data.trees) {
        if (largest == nullptr || tree.triangleCount > largest->triangleCount) largest = &tree;
        figures.depth = std::max(figures.depth, static_cast<int>(tree.depth));
    }
    if (largest != nullptr) figures.epo = treeEpo(data, *largest);
    figures.depth += static_cast<int>(data.upperDepth);
    figures.nodes = data.nodes.size();
    figures.trees = data.trees.size();
    figures.skipped = data.skippedTriangles;
    figures.bytes = std::as_bytes(std::span(data.nodes)).size() + std::as_bytes(std::span(data.triangles)).size() +
                    std::as_bytes(std::span(data.instances)).size();
    return figures;
}

/// What the scene takes on the device apart from the traversal's structures.
size_t measureSceneBytes(const Scene& scene, float radius) {
    const GeometryData geometry = packGeometry(scene);
    MaterialTables materials = packMaterials(scene);
    const LightTables lights = packLights(scene, radius, materials);
    const auto bytes = [](const auto& data) { return std::as_bytes(std::span(data)).size(); };
    return bytes(geometry.instances) + bytes(geometry.triangles) + bytes(geometry.vertices) + bytes(materials.materials) +
           bytes(materials.textures) + bytes(materials.texels) + bytes(lights.emissive) + bytes(lights.punctual) +
           bytes(lights.environment) + bytes(lights.environmentAlias);
}

Info gather(const std::filesystem::path& path) {
    Info info;
    const Stopwatch watch;
    info.scene = importScene(path);
    info.importSeconds = watch.seconds();
    settleEnvironment(info.scene, {});
    info.bounds = sceneBounds(info.scene);
    info.triangles = triangleCount(info.scene);
    info.needs = analyseNeeds(info.scene);
    info.bvh = measureBvh(info.scene);
    info.sceneBytes = measureSceneBytes(info.scene, 0.5f * glm::length(info.bounds.hi - info.bounds.lo));
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
            {"instances", info.scene.instances.size()},
            {"meshes", info.scene.meshes.size()},
            {"materials", info.scene.materials.size()},
            {"textures", info.scene.textures.size()},
            {"lights", info.scene.lights.size()},
            {"cameras", cameras},
            {"bounds", {{"lo", vec(info.bounds.lo)}, {"hi", vec(info.bounds.hi)}}},
            {"needs", needs},
            {"memoryBytes", info.sceneBytes + info.bvh.bytes},
            {"bvh",
             {{"sah", info.bvh.sah},
              {"epo", info.bvh.epo},
              {"depth", info.bvh.depth},
              {"nodes", info.bvh.nodes},
              {"trees", info.bvh.trees},
              {"buildMs", info.bvh.buildMs},
              {"bytes", info.bvh.bytes},
              {"skippedTriangles", info.bvh.skipped}}},
            {"seconds", {{"import", info.importSeconds}}},
            {"warnings", info.scene.warnings}};
}

void printInfo(const InfoOptions& options, const Info& info) {
    const Scene& s = info.scene;
    const auto mebibytes = [](size_t bytes) { return static_cast<double>(bytes) / (1 << 20); };
    std::cout << std::fixed << std::setprecision(1) << options.scene << "  (import " << info.importSeconds << " s)\n"
              << "  triangles   " << info.triangles.stored << " stored, " << info.triangles.instanced << " shown\n"
              << "  meshes      " << s.meshes.size() << " in " << s.instances.size() << " instances\n"
              << "  materials   " << s.materials.size() << ", textures " << s.textures.size() << "\n"
              << "  lights      " << s.lights.size() << " punctual\n  cameras     " << s.cameras.size();
    for (const Camera& camera : s.cameras) std::cout << "  '" << camera.name << "'";
    std::cout << std::setprecision(3) << "\n  bounds      (" << info.bounds.lo.x << ", " << info.bounds.lo.y << ", " << info.bounds.lo.z
              << ") to (" << info.bounds.hi.x << ", " << info.bounds.hi.y << ", " << info.bounds.hi.z << ")\n"
              << std::setprecision(1) << "  memory      " << mebibytes(info.sceneBytes) << " MiB scene + " << mebibytes(info.bvh.bytes)
              << " MiB BVH\n"
              << "  BVH         " << info.bvh.trees << (info.bvh.trees == 1 ? " tree, " : " trees, ") << info.bvh.nodes << " nodes, depth "
              << info.bvh.depth << ", SAH " << info.bvh.sah << ", EPO " << info.bvh.epo << ", built in " << info.bvh.buildMs << " ms";
    if (info.bvh.skipped > 0) std::cout << ", " << info.bvh.skipped << " degenerate triangles left out";
    std::cout << "\n\nThe kernel for this scene contains\n";
    for (const Need& need : info.needs.needs)
        std::cout << "  " << (need.needed ? "[x] " : "[ ] ") << std::left << std::setw(20) << need.name << need.reason << "\n";
    if (!s.warnings.empty()) std::cout << "\nWarnings\n";
    for (const std::string& warning : s.warnings) std::cout << "  " << warning << "\n";
}

ExitCode showInfo(const InfoOptions& options) {
    const Info info = gather(scenePath(options.scene));
    if (!options.json.empty()) writeJson(options.json, infoJson(options, info));
    if (options.json != "-") printInfo(options, info);
    return ExitCode::done;
}

}  // namespace

void addInfoCommand(CLI::App& app, Command& chosen) {
    CLI::App* command = app.add_subcommand("info", "contents of a scene, its BVH, and what its kernel needs");
    const auto options = std::make_shared<InfoOptions>();
    command->add_option("scene", options->scene, "glTF, GLB, OBJ, PLY or STL; or the name of a scene of raylab's own")->required();
    command->add_option("--json", options->json, "write all of it to a file, or - for standard output")->type_name("FILE");
    command->callback([&chosen, options] { chosen = [options] { return showInfo(*options); }; });
}

}  // namespace raylab
