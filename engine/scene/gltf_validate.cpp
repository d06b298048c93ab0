#include "engine/scene/gltf_validate.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "engine/core/error.h"
#include "engine/scene/gltf_accessor.h"

namespace raylab {
namespace {

constexpr std::array<std::string_view, 13> kReadableExtensions = {"KHR_lights_punctual",
                                                                  "KHR_materials_emissive_strength",
                                                                  "KHR_materials_ior",
                                                                  "KHR_materials_specular",
                                                                  "KHR_materials_transmission",
                                                                  "KHR_materials_unlit",
                                                                  "KHR_materials_volume",
                                                                  "KHR_mesh_quantization",
                                                                  "KHR_texture_transform",
                                                                  "KHR_materials_anisotropy",
                                                                  "KHR_materials_clearcoat",
                                                                  "KHR_materials_sheen",
                                                                  "KHR_materials_pbrSpecularGlossiness"};

void requireReadableExtensions(const JsonView& root) {
    const JsonView required = root.array("extensionsRequired");
    for (const nlohmann::json& entry : required.json()) {
        if (!entry.is_string()) required.fail("must hold strings");
        const std::string name = entry.get<std::string>();
        if (std::find(kReadableExtensions.begin(), kReadableExtensions.end(), name) == kReadableExtensions.end())
            throw Error(root.file() + ": needs the extension " + name +
                        ", which is not read; export it again without (no Draco or meshopt compression, for example)");
    }
}

void checkIndexArray(const JsonView& owner, const char* key, size_t size) {
    const JsonView indices = owner.array(key);
    for (size_t i = 0; i < indices.size(); ++i) indices.indexAt(i, size);
}

void checkPrimitive(const GltfDocument& document, const JsonView& primitive) {
    const JsonView root = document.root();
    const size_t accessorCount = root.array("accessors").size();
    const JsonView attributes = primitive.object("attributes");
    for (const auto& [name, value] : attributes.json().items()) attributes.index(name.c_str(), accessorCount);
    if (const auto position = attributes.index("POSITION", accessorCount);
        position && accessorAt(document, *position).components != 3)
        attributes.fail("names a POSITION that is not VEC3");
    primitive.index("indices", accessorCount);
    primitive.index("material", root.array("materials").size());
    if (primitive.count("mode", 4) > 6) primitive.fail("has a mode that glTF does not know");
}

void checkMeshes(const GltfDocument& document) {
    const JsonView meshes = document.root().array("meshes");
    for (size_t m = 0; m < meshes.size(); ++m) {
        const JsonView primitives = meshes.element(m).array("primitives");
        for (size_t p = 0; p < primitives.size(); ++p) checkPrimitive(document, primitives.element(p));
    }
}

/// Depth-first colouring over an explicit stack: a node reached again while it is still open closes a cycle.
void requireNoCycle(const JsonView& nodes) {
    enum class Colour : uint8_t { unseen, open, done };
    std::vector<Colour> colours(nodes.size(), Colour::unseen);
    struct Frame {
        size_t node;
        size_t nextChild;
    };
    for (size_t start = 0; start < nodes.size(); ++start) {
        std::vector<Frame> stack;
        if (colours[start] == Colour::unseen) stack.push_back({start, 0});
        while (!stack.empty()) {
            Frame& frame = stack.back();
            colours[frame.node] = Colour::open;
            const JsonView node = nodes.element(frame.node);
            const JsonView children = node.array("children");
            if (frame.nextChild == children.size()) {
                colours[frame.node] = Colour::done;
                stack.pop_back();
                continue;
            }
            const size_t child = children.indexAt(frame.nextChild++, nodes.size());
            if (colours[child] == Colour::open) node.fail("is its own descendant");
            if (colours[child] == Colour::unseen) stack.push_back({child, 0});
        }
    }
}

void checkNodes(const JsonView& root) {
    const JsonView nodes = root.array("nodes");
    const size_t lightCount = root.object("extensions").object("KHR_lights_punctual").array("lights").size();
    const size_t meshCount = root.array("meshes").size();
    const size_t cameraCount = root.array("cameras").size();
    for (size_t n = 0; n < nodes.size(); ++n) {
        const JsonView node = nodes.element(n);
        node.index("mesh", meshCount);
        node.index("camera", cameraCount);
        if (node.has("extensions")) node.object("extensions").object("KHR_lights_punctual").index("light", lightCount);
    }
    requireNoCycle(nodes);
}

void checkScenes(const JsonView& root) {
    const JsonView scenes = root.array("scenes");
    root.index("scene", scenes.size());
    for (size_t s = 0; s < scenes.size(); ++s) checkIndexArray(scenes.element(s), "nodes", root.array("nodes").size());
}

void checkImages(const JsonView& root) {
    const JsonView textures = root.array("textures");
    for (size_t t = 0; t < textures.size(); ++t) {
        textures.element(t).index("source", root.array("images").size());
        textures.element(t).index("sampler", root.array("samplers").size());
    }
}

}  // namespace

void validateGltf(const GltfDocument& document) {
    const JsonView root = document.root();
    requireReadableExtensions(root);
    for (size_t v = 0; v < root.array("bufferViews").size(); ++v) viewBytes(document, v);
    for (size_t a = 0; a < root.array("accessors").size(); ++a) accessorAt(document, a);
    checkMeshes(document);
    checkNodes(root);
    checkScenes(root);
    checkImages(root);
}

}  // namespace raylab
