#include "ui/editor/model/merge_scene.h"

#include <memory>

#include "engine/scene/texture_slots.h"
#include "ui/editor/model/edit_instances.h"

namespace raylab::editor {
namespace {

template <class List>
uint32_t count(const List& list) {
    return static_cast<uint32_t>(list.size());
}

void appendMaterials(const Scene& other, Scene& scene) {
    const auto firstTexture = static_cast<int32_t>(scene.textures.size());
    for (const Shared<Texture>& texture : other.textures.shared()) scene.textures.shared().push_back(texture);
    for (Material material : other.materials) {
        for (int32_t* const texture : textureSlots(material))
            if (*texture != kNoTexture) *texture += firstTexture;
        scene.materials.push_back(std::move(material));
    }
}

/// Without the lengths of the matrix' columns.
glm::vec3 turned(const glm::mat4& placement, glm::vec3 direction) {
    return glm::normalize(glm::mat3(placement) * direction);
}

glm::vec3 moved(const glm::mat4& placement, glm::vec3 point) { return glm::vec3(placement * glm::vec4(point, 1.0f)); }

void appendViewsAndLights(const Scene& other, const glm::mat4& placement, Scene& scene) {
    const bool stays = placement == glm::mat4(1.0f);
    for (Camera camera : other.cameras) {
        if (!stays) {
            camera.position = moved(placement, camera.position);
            camera.target = moved(placement, camera.target);
            camera.up = turned(placement, camera.up);
        }
        scene.cameras.push_back(std::move(camera));
    }
    for (Light light : other.lights) {
        if (!stays) {
            light.position = moved(placement, light.position);
            light.direction = turned(placement, light.direction);
        }
        scene.lights.push_back(std::move(light));
    }
}

void merge(const Scene& other, const glm::mat4& placement, EditState& state) {
    Scene& scene = state.scene;
    const uint32_t firstMaterial = count(scene.materials), firstMesh = count(scene.meshes);
    appendMaterials(other, scene);
    for (Mesh mesh : other.meshes) {
        mesh.material += firstMaterial;
        scene.meshes.push_back(std::move(mesh));
    }
    state.selection = {};
    for (Instance instance : other.instances) {
        instance.mesh += firstMesh;
        instance.objectToWorld = placement * instance.objectToWorld;
        if (instance.endToWorld) instance.endToWorld = placement * *instance.endToWorld;
        state.selection.instances.push_back(insertInstance(state, std::move(instance)));
    }
    appendViewsAndLights(other, placement, scene);
    if (scene.environment || scene.sky) return;
    scene.environment = other.environment;
    scene.sky = other.sky;
}

}  // namespace

Edit mergeScene(Scene other, const glm::mat4& placement) {
    return {"Merge " + other.name, [other = std::make_shared<const Scene>(std::move(other)),
                                    placement](EditState& state) { merge(*other, placement, state); }};
}

}  // namespace raylab::editor
