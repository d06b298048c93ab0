#include <assimp/scene.h>
#include <tbb/parallel_for.h>

#include <charconv>
#include <string_view>

#include "engine/scene/assimp_reader.h"
#include "engine/scene/gltf_extras.h"
#include "engine/scene/gltf_geometry.h"
#include "engine/scene/gltf_material.h"
#include "engine/scene/gltf_nodes.h"
#include "engine/scene/gltf_validate.h"
#include "engine/scene/import_material.h"
#include "engine/scene/import_parts.h"

namespace raylab {
namespace {

/// Assimp's mesh of each part; null where it found no triangle.
std::vector<const aiMesh*> meshesOfParts(const aiScene& source, size_t partCount) {
    std::vector<const aiMesh*> meshes(partCount, nullptr);
    for (unsigned m = 0; m < source.mNumMeshes; ++m) {
        const std::string_view name = source.mMeshes[m]->mName.C_Str();
        size_t part = partCount;
        std::from_chars(name.data(), name.data() + name.size(), part);
        if (part < partCount) meshes[part] = source.mMeshes[m];
    }
    return meshes;
}

void bakeUvTransform(Mesh& mesh, const glm::mat3& transform) {
    if (transform == glm::mat3(1.0f)) return;
    for (glm::vec2& uv : mesh.uvs) uv = glm::vec2(transform * glm::vec3(uv, 1.0f));
}

/// Material of parts that name none; made when the first asks for it.
uint32_t materialIndex(Scene& scene, const std::optional<size_t>& material, std::optional<uint32_t>& fallback) {
    if (material) return static_cast<uint32_t>(*material);
    if (!fallback) {
        fallback = static_cast<uint32_t>(scene.materials.size());
        scene.materials.push_back(defaultMaterial());
    }
    return *fallback;
}

void convertParts(const GltfDocument& document, const PlainGltf& plain, std::span<const UvUse> uvUses,
                  SceneDraft& draft) {
    Scene& scene = draft.scene;
    if (plain.parts.empty()) return;
    Assimp::Importer importer;
    const std::vector<const aiMesh*> sources =
        meshesOfParts(readPlainGltf(importer, document, plain), plain.parts.size());
    scene.meshes.resize(plain.parts.size());
    std::vector<MeshRepairs> repairs(plain.parts.size());
    tbb::parallel_for(size_t{0}, plain.parts.size(), [&](size_t p) {
        if (!sources[p]) return;
        scene.meshes[p] = convertMesh(*sources[p], {}, repairs[p]);
        if (plain.parts[p].material) bakeUvTransform(scene.meshes[p], uvUses[*plain.parts[p].material].transform);
    });
    std::optional<uint32_t> fallback;
    for (size_t p = 0; p < plain.parts.size(); ++p) {
        scene.meshes[p].name = plain.parts[p].name;
        scene.meshes[p].material = materialIndex(scene, plain.parts[p].material, fallback);
        draft.repairs += repairs[p];
    }
}

void placeInstances(const GltfDocument& document, const std::vector<PlacedNode>& nodes, const PlainGltf& plain,
                    SceneDraft& draft) {
    const JsonView allNodes = document.root().array("nodes");
    const size_t meshCount = document.root().array("meshes").size();
    std::vector<std::vector<size_t>> partsOf(meshCount);
    for (size_t p = 0; p < plain.parts.size(); ++p) partsOf[plain.parts[p].mesh].push_back(p);
    for (const PlacedNode& placed : nodes) {
        const JsonView node = allNodes.element(placed.node);
        const auto mesh = node.index("mesh", meshCount);
        if (!mesh) continue;
        const std::string name = node.text("name", "node " + std::to_string(placed.node));
        for (const size_t part : partsOf[*mesh]) placeInstance(draft, name, part, placed.toWorld);
    }
}

}  // namespace

Scene importGltf(const std::filesystem::path& path) {
    const GltfDocument document = loadGltf(path);
    validateGltf(document);
    SceneDraft draft;
    Scene& scene = draft.scene;
    const std::vector<PlacedNode> nodes = placeNodes(document);
    const std::vector<UvUse> uvUses = readGltfMaterials(document, draft.requests, scene);
    std::vector<size_t> uvSets;
    for (const UvUse& use : uvUses) uvSets.push_back(use.set);
    const PlainGltf plain = plainGeometry(document, nodes, uvSets, scene.warnings);
    convertParts(document, plain, uvUses, draft);
    placeInstances(document, nodes, plain, draft);
    readGltfCameras(document, nodes, scene);
    readGltfLights(document, nodes, scene);
    readGltfExtras(document, scene);
    return finishScene(std::move(draft), path);
}

}  // namespace raylab
