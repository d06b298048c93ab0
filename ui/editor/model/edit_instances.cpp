#include "ui/editor/model/edit_instances.h"

#include <algorithm>
#include <map>
#include <set>

#include "engine/core/error.h"
#include "engine/scene/import_parts.h"
#include "ui/editor/model/edit_materials.h"

namespace raylab::editor {
namespace {

std::string counted(size_t count) { return count == 1 ? "instance" : std::to_string(count) + " instances"; }

/// What the importer would refuse cannot come to be: it would be lost between Save and the next start.
void requirePlaceable(const Placement& placement, const Scene& scene) {
    const glm::mat4& m = placement.objectToWorld;
    const bool isAffine = m[0][3] == 0.0f && m[1][3] == 0.0f && m[2][3] == 0.0f && m[3][3] == 1.0f;
    if (!isAffine || !isBounded(m) || !isInvertible(m))
        throw Error("'" + scene.instances[placement.instance].name +
                    "' cannot be placed so: its matrix would be singular or not finite; choose scales other than 0");
}

std::set<uint32_t> setOf(const std::vector<uint32_t>& list) { return {list.begin(), list.end()}; }

void keepOnly(EditState& state, const std::set<uint32_t>& gone) {
    std::vector<Instance> instances;
    std::vector<uint8_t> hidden;
    for (uint32_t i = 0; i < state.scene.instances.size(); ++i) {
        if (gone.contains(i)) continue;
        instances.push_back(std::move(state.scene.instances[i]));
        hidden.push_back(state.hidden[i]);
    }
    state.scene.instances = std::move(instances);
    state.hidden = std::move(hidden);
    state.selection.instances.clear();
}

/// Whether no instance but those of `instances` shows the mesh.
bool showAllOf(uint32_t mesh, const std::set<uint32_t>& instances, const Scene& scene) {
    for (uint32_t i = 0; i < scene.instances.size(); ++i)
        if (scene.instances[i].mesh == mesh && !instances.contains(i)) return false;
    return true;
}

void wear(Scene& scene, const std::set<uint32_t>& instances, uint32_t material) {
    std::map<uint32_t, uint32_t> meshes;  ///< from a mesh to the one that wears the material
    for (const uint32_t i : instances) {
        const uint32_t mesh = scene.instances[i].mesh;
        if (std::as_const(scene.meshes)[mesh].material == material) continue;
        auto [worn, isNew] = meshes.try_emplace(mesh, mesh);
        if (isNew && !showAllOf(mesh, instances, scene)) {
            worn->second = static_cast<uint32_t>(scene.meshes.size());
            scene.meshes.push_back(std::as_const(scene.meshes)[mesh]);
        }
        if (isNew) scene.meshes[worn->second].material = material;
        scene.instances[i].mesh = worn->second;
    }
    supplyTangents(scene, material);
}

}  // namespace

std::string namesOf(const Scene& scene, std::span<const uint32_t> instances) {
    if (instances.size() != 1) return std::to_string(instances.size()) + " instances";
    const std::string& name = scene.instances[instances.front()].name;
    return name.empty() ? "instance " + std::to_string(instances.front()) : name;
}

uint32_t insertInstance(EditState& state, Instance instance) {
    state.scene.instances.push_back(std::move(instance));
    state.hidden.push_back(0);
    return static_cast<uint32_t>(state.scene.instances.size() - 1);
}

Edit placeInstances(std::vector<Placement> placements, const std::string& verb, std::string mergeKey) {
    const std::string name = verb + " " + counted(placements.size());
    const auto change = [placements = std::move(placements)](EditState& state) {
        for (const Placement& placement : placements) {
            requirePlaceable(placement, state.scene);
            Instance& instance = state.scene.instances[placement.instance];
            const glm::mat4 before = instance.objectToWorld;
            glm::mat4& matrix = instance.objectToWorld;
            matrix = placement.objectToWorld;
            for (int c = 0; c < 3; ++c) matrix[c][3] = 0.0f;  // not -0, which no file keeps
            // The motion goes along.
            if (instance.endToWorld) instance.endToWorld = matrix * glm::inverse(before) * *instance.endToWorld;
        }
    };
    return {name, change, std::move(mergeKey)};
}

Edit renameInstance(uint32_t instance, std::string name) {
    return {"Rename instance",
            [instance, name = std::move(name)](EditState& state) { state.scene.instances[instance].name = name; }};
}

Edit duplicateInstances(std::vector<uint32_t> instances) {
    const std::string name = "Duplicate " + counted(instances.size());
    return {name, [instances = std::move(instances)](EditState& state) {
                state.selection = {};
                for (const uint32_t i : instances) {
                    Instance copy = state.scene.instances[i];
                    copy.name += " copy";
                    state.selection.instances.push_back(insertInstance(state, std::move(copy)));
                }
            }};
}

Edit deleteInstances(std::vector<uint32_t> instances) {
    const std::string name = "Delete " + counted(instances.size());
    return {name, [gone = setOf(instances)](EditState& state) {
                if (gone.size() >= state.scene.instances.size())
                    throw Error("a scene keeps at least one instance; add another one before, or hide this one");
                keepOnly(state, gone);
            }};
}

Edit showInstances(std::vector<uint32_t> instances, bool shown) {
    const std::string name = (shown ? "Show " : "Hide ") + counted(instances.size());
    return {name, [instances = std::move(instances), shown](EditState& state) {
                for (const uint32_t i : instances) state.hidden[i] = shown ? 0 : 1;
            }};
}

Edit isolateInstances(std::vector<uint32_t> instances) {
    const std::string name = "Isolate " + counted(instances.size());
    return {name, [instances = std::move(instances)](EditState& state) {
                std::fill(state.hidden.begin(), state.hidden.end(), uint8_t{1});
                for (const uint32_t i : instances) state.hidden[i] = 0;
            }};
}

Edit showAllInstances() {
    return {"Show all", [](EditState& state) { std::fill(state.hidden.begin(), state.hidden.end(), uint8_t{0}); }};
}

Edit assignMaterial(std::vector<uint32_t> instances, uint32_t material) {
    const std::string name = "Assign material to " + counted(instances.size());
    return {name,
            [instances = setOf(instances), material](EditState& state) { wear(state.scene, instances, material); }};
}

}  // namespace raylab::editor
