#include <assimp/scene.h>
#include <tbb/parallel_for.h>

#include <charconv>
#include <string_view>

#include "engine/scene/assimp_reader.h"
#include "engine/scene/gltf_extras.h"
#include "engine/scene/gltf_geometry.h"
#include "engine/scene/gltf_material.h"
#include "engine/scene/gltf_nodes.h"
#include "engine/scene/gltf_quadrics.h"
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
                  std::optional<uint32_t>& fallbackMaterial, SceneDraft& draft) {
    Scene& scene = draft.scene;
    if (plain.parts.empty()) return;
    Assimp::Importer importer;
    const std::vector<const aiMesh*> sources =
        meshesOfParts(readPlainGltf(importer, document, plain), plain.parts.size());
    scene.meshes.resize(plain.parts.size());
    std::vector<MeshRepairs> repairs(plain.parts.size());
    tbb::parallel_for(size_t{0}, plain.parts.size(), [&](size_t p) {
        if (!sources[p]) return;
        scene.meshes[p] = convertMesh(*sources[p], {.uvs = UvForm::plainGltf}, repairs[p]);
        if (plain.parts[p].material) bakeUvTransform(scene.meshes[p], uvUses[*plain.parts[p].material].transform);
    });
    for (size_t p = 0; p < plain.parts.size(); ++p) {
        scene.meshes[p].name = plain.parts[p].name;
        scene.meshes[p].material = materialIndex(scene, plain.parts[p].material, fallbackMaterial);
        draft.repairs += repairs[p];
    }
}

/// Appends a mesh an entry; result: the number of entries.
size_t addQuadrics(const GltfDocument& document, std::span<const UvUse> uvUses,
                   std::optional<uint32_t>& fallbackMaterial, Scene& scene) {
    std::vector<GltfQuadrics> entries = readGltfQuadrics(document);
    for (GltfQuadrics& entry : entries) {
        if (entry.material && uvUses[*entry.material].transform != glm::mat3(1.0f))
            scene.warnings.push_back("quadrics \"" + entry.mesh.name +
                                     "\" ignore the KHR_texture_transform of their material");
        entry.mesh.material = materialIndex(scene, entry.material, fallbackMaterial);
        scene.meshes.push_back(std::move(entry.mesh));
    }
    return entries.size();
}

/// The meshes of the parts come first, those of the quadrics after them.
void placeInstances(const GltfDocument& document, const std::vector<PlacedNode>& nodes, const PlainGltf& plain,
                    size_t quadricsCount, SceneDraft& draft) {
    const JsonView allNodes = document.root().array("nodes");
    const size_t meshCount = document.root().array("meshes").size();
    std::vector<std::vector<size_t>> partsOf(meshCount);
    for (size_t p = 0; p < plain.parts.size(); ++p) partsOf[plain.parts[p].mesh].push_back(p);
    for (const PlacedNode& placed : nodes) {
        const JsonView node = allNodes.element(placed.node);
        const auto mesh = node.index("mesh", meshCount);
        const auto quadrics = quadricsOfNode(node, quadricsCount);
        if (!mesh && !quadrics) continue;
        const std::string name = node.text("name", "node " + std::to_string(placed.node));
        if (mesh)
            for (const size_t part : partsOf[*mesh]) placeInstance(draft, name, part, placed.toWorld, placed.endToWorld);
        if (quadrics)
            placeInstance(draft, name, plain.parts.size() + *quadrics, placed.toWorld, placed.endToWorld);
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
    std::optional<uint32_t> fallbackMaterial;
    convertParts(document, plain, uvUses, fallbackMaterial, draft);
    const size_t quadricsCount = addQuadrics(document, uvUses, fallbackMaterial, scene);
    placeInstances(document, nodes, plain, quadricsCount, draft);
    readGltfCameras(document, nodes, scene);
    readGltfLights(document, nodes, scene);
    readGltfExtras(document, scene);
    return finishScene(std::move(draft), path);
}

}  // namespace raylab
