#include <assimp/scene.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "engine/scene/assimp_reader.h"
#include "engine/scene/import_material.h"
#include "engine/scene/import_parts.h"
#include "engine/scene/ply_validate.h"

namespace raylab {
namespace {

MeshOptions optionsFor(const std::string& extension) {
    // PLY vertices are shared in the file; the others arrive with three of their own for every triangle.
    if (extension == ".ply") return {.normals = NormalRule::smooth, .weld = false};
    if (extension == ".stl") return {.normals = NormalRule::flat, .weld = true};
    return {.normals = NormalRule::keep, .weld = true};
}

glm::dmat4 toMatrix(const aiMatrix4x4& m) {
    return glm::dmat4(m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4);
}

void convertMeshes(const aiScene& source, const MeshOptions& options, SceneDraft& draft) {
    SharedList<Mesh>& meshes = draft.scene.meshes;
    meshes.resize(source.mNumMeshes);
    std::vector<MeshRepairs> repairs(meshes.size());
    tbb::parallel_for(size_t{0}, meshes.size(), [&](size_t m) {
        meshes[m] = convertMesh(*source.mMeshes[m], options, repairs[m]);
        const auto lastMaterial = static_cast<uint32_t>(draft.scene.materials.size() - 1);
        meshes[m].material = std::min(source.mMeshes[m]->mMaterialIndex, lastMaterial);
    });
    for (const MeshRepairs& each : repairs) draft.repairs += each;
}

void placeAiNodes(const aiScene& source, SceneDraft& draft) {
    struct Frame {
        const aiNode* node;
        glm::dmat4 toWorld;
    };
    std::vector<Frame> stack = {{source.mRootNode, toMatrix(source.mRootNode->mTransformation)}};
    while (!stack.empty()) {
        const Frame frame = stack.back();
        stack.pop_back();
        for (unsigned i = 0; i < frame.node->mNumMeshes; ++i)
            if (frame.node->mMeshes[i] < draft.scene.meshes.size())
                placeInstance(draft, frame.node->mName.C_Str(), frame.node->mMeshes[i], frame.toWorld,
                              frame.toWorld);
        for (unsigned c = frame.node->mNumChildren; c-- > 0;)
            stack.push_back(
                {frame.node->mChildren[c], frame.toWorld * toMatrix(frame.node->mChildren[c]->mTransformation)});
    }
}

/// Assimp tries further names beside a missing material library; one sentence is enough.
void reportNotes(const FileNotes& notes, std::vector<std::string>& warnings) {
    if (!notes.missing.empty())
        warnings.push_back("material library " + notes.missing.front() + " was not found; its materials are grey");
    if (!notes.orphans.empty())
        warnings.push_back("material library " + notes.orphans +
                           " has statements before its first newmtl, which are left out");
}

}  // namespace

Scene importThroughAssimp(const std::filesystem::path& path, const std::string& extension) {
    Assimp::Importer importer;
    SceneDraft draft;
    FileNotes notes;
    if (extension == ".ply") validatePly(path);
    const aiScene& source = readSceneFile(importer, path, notes);
    reportNotes(notes, draft.scene.warnings);
    readPhongMaterials(source, path, draft.requests, draft.scene);
    convertMeshes(source, optionsFor(extension), draft);
    placeAiNodes(source, draft);
    return finishScene(std::move(draft), path);
}

}  // namespace raylab
