#include "engine/scene/import.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/scene/bounds.h"
#include "engine/scene/instance_motion.h"
#include "engine/scene/import_parts.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtensions[] = {".gltf", ".glb", ".obj", ".ply", ".stl"};

void dropUnusedMeshes(Scene& scene) {
    std::vector<bool> used(scene.meshes.size(), false);
    for (const Instance& instance : scene.instances) used[instance.mesh] = true;
    std::vector<uint32_t> newIndex(scene.meshes.size());
    SharedList<Mesh> kept;
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        newIndex[m] = static_cast<uint32_t>(kept.size());
        used[m] = used[m] && !(scene.meshes[m].triangles.empty() && scene.meshes[m].quadrics.empty());
        if (used[m]) kept.push_back(std::move(scene.meshes[m]));
    }
    std::erase_if(scene.instances, [&used](const Instance& instance) { return !used[instance.mesh]; });
    for (Instance& instance : scene.instances) instance.mesh = newIndex[instance.mesh];
    scene.meshes = std::move(kept);
}

void dropUnusedMaterials(Scene& scene) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const Mesh& mesh : scene.meshes) used[mesh.material] = true;
    std::vector<uint32_t> newIndex(scene.materials.size());
    std::vector<Material> kept;
    for (size_t m = 0; m < scene.materials.size(); ++m) {
        newIndex[m] = static_cast<uint32_t>(kept.size());
        if (used[m]) kept.push_back(std::move(scene.materials[m]));
    }
    for (Mesh& mesh : scene.meshes) mesh.material = newIndex[mesh.material];
    scene.materials = std::move(kept);
}

void requireSurfaces(const Scene& scene, const fs::path& path) {
    if (!scene.instances.empty()) return;
    std::string message = path.string() + ": there is nothing to render in it, not one triangle or quadric";
    for (size_t i = 0; i < std::min<size_t>(scene.warnings.size(), 3); ++i) message += "; " + scene.warnings[i];
    throw Error(message + "; open a file with surfaces");
}

/// Names a few; a file may hold thousands.
void reportSingular(const std::vector<std::string>& names, std::vector<std::string>& warnings) {
    if (names.empty()) return;
    std::string list;
    for (size_t i = 0; i < std::min<size_t>(names.size(), 5); ++i) list += (i == 0 ? " \"" : ", \"") + names[i] + "\"";
    warnings.push_back("instances left out for a singular or non-finite transform: " + std::to_string(names.size()) +
                       ":" + list + (names.size() > 5 ? ", ..." : ""));
}

void supplyTangents(Scene& scene) {
    tbb::parallel_for(size_t{0}, scene.meshes.size(), [&scene](size_t m) {
        Mesh& mesh = scene.meshes[m];
        if (wantsTangents(scene.materials[mesh.material])) ensureTangents(mesh);
    });
}

/// From here on a unit in the last place of a coordinate shows: as a part of the scene's diagonal.
constexpr double kVisibleRounding = 1e-3;

/// Far from the origin, floats lie so far apart that surfaces lose their shape.
void reportDistance(Scene& scene) {
    const Bounds bounds = sceneBounds(scene);
    const glm::dvec3 lo(bounds.lo), hi(bounds.hi), farthest = glm::max(glm::abs(lo), glm::abs(hi));
    const double largest = std::max({farthest.x, farthest.y, farthest.z}), rounding = largest * 0x1p-23;
    if (!(rounding > kVisibleRounding * glm::length(hi - lo))) return;
    std::ostringstream text;
    text << "the scene lies " << largest << " units from the origin and is " << glm::length(hi - lo)
         << " units large: positions are rounded to " << rounding << "; move it to the origin";
    scene.warnings.push_back(text.str());
}

}  // namespace

std::string lowerExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool isBounded(const glm::dmat4& transform) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r)
            if (!(std::abs(transform[c][r]) <= static_cast<double>(kLargestSceneCoordinate))) return false;
    return true;
}

bool isInvertible(const glm::dmat4& matrix) {
    double lengths = 1.0;
    for (int c = 0; c < 3; ++c) lengths *= glm::length(glm::dvec3(matrix[c]));
    return std::abs(glm::determinant(glm::dmat3(matrix))) > 1e-7 * lengths;
}

void placeInstance(SceneDraft& draft, const std::string& name, size_t mesh, const glm::dmat4& toWorld,
                   const glm::dmat4& endToWorld) {
    const glm::mat4 stored(toWorld), end(endToWorld);
    if (!isBounded(stored) || !isInvertible(stored)) {
        draft.singular.push_back(name);
        return;
    }
    Instance instance{name, static_cast<uint32_t>(mesh), stored};
    if (stored != end && isBounded(end) && isInvertibleBetween(stored, end))
        instance.endToWorld = end;
    else if (stored != end)
        draft.scene.warnings.push_back("instance \"" + name +
                                       "\" stands still: the matrices between the ends of its motion flatten it (a turn by "
                                       "half does); let the shutter close sooner");
    draft.scene.instances.push_back(std::move(instance));
}

Scene finishScene(SceneDraft&& draft, const fs::path& path) {
    Scene scene = std::move(draft.scene);
    scene.name = path.stem().string();
    draft.repairs.report(scene.warnings);
    reportSingular(draft.singular, scene.warnings);
    dropUnusedMeshes(scene);
    requireSurfaces(scene, path);
    dropUnusedMaterials(scene);
    resolveTextures(draft.requests, scene);
    supplyTangents(scene);
    reportDistance(scene);
    return scene;
}

std::string importableExtensions() {
    std::string list;
    for (const char* extension : kExtensions) {
        if (!list.empty()) list += ' ';
        list += extension;
    }
    return list;
}

Scene importScene(const fs::path& path) {
    requireReadableFile(path);
    const std::string extension = lowerExtension(path);
    if (std::find(std::begin(kExtensions), std::end(kExtensions), extension) == std::end(kExtensions))
        throw Error(path.string() + ": \"" + extension + "\" is not a scene format that is read; supported are " +
                    importableExtensions());
    try {
        return extension == ".gltf" || extension == ".glb" ? importGltf(path) : importThroughAssimp(path, extension);
    } catch (const std::bad_alloc&) {
        throw Error(path.string() + ": not enough memory to read it; it is too large, or damaged");
    }
}

}  // namespace raylab
