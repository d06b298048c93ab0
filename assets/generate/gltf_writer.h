#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "assets/generate/mesh_tools.h"

namespace raylab::assets {

/// A glTF 2.0 metallic-roughness material. Colours are linear; texture ids come from GltfWriter::addTexture().
struct MaterialSpec {
    std::string name;
    glm::vec3 baseColor{1.0f};
    float metallic = 0.0f;
    float roughness = 1.0f;
    std::optional<uint32_t> baseColorTexture = {};
    std::optional<uint32_t> metallicRoughnessTexture = {};
    std::optional<uint32_t> normalTexture = {};
    float normalScale = 1.0f;
    glm::vec3 emission{0.0f};               ///< radiance; beyond 1 by KHR_materials_emissive_strength
    std::optional<float> alphaCutoff = {};  ///< alpha mask
    bool doubleSided = false;
    float transmission = 0.0f;  ///< KHR_materials_transmission
    float ior = 1.5f;           ///< KHR_materials_ior
    float thickness = 0.0f;     ///< metres; above 0 the surface bounds a volume (KHR_materials_volume)
    float specular = 1.0f;      ///< KHR_materials_specular
};

/// Collects one scene and writes it as a self-contained GLB (glTF 2.0, section 4.4). Meshes are stored once; an
/// instance is a node. Vertices and indices are tightly packed float32 and uint32.
class GltfWriter {
public:
    explicit GltfWriter(std::string sceneName);

    /// `png` is a whole PNG file. Textures repeat in both directions.
    uint32_t addTexture(const std::string& name, const std::vector<uint8_t>& png);
    uint32_t addMaterial(const MaterialSpec& spec);
    uint32_t addMesh(const std::string& name, const Geometry& geometry, uint32_t material);
    void addInstance(const std::string& name, uint32_t mesh, const glm::mat4& objectToWorld = glm::mat4(1.0f));
    void addCamera(const std::string& name, glm::vec3 eye, glm::vec3 target, float fovYRadians, float aspect);
    /// Becomes `extras` of the scene.
    void setExtras(nlohmann::json extras);

    /// Writes to a temporary name and renames. Throws std::runtime_error where the file cannot be written.
    void write(const std::filesystem::path& path) const;

private:
    uint32_t addBufferView(const void* data, size_t sizeBytes, int target);
    uint32_t addAccessor(uint32_t view, int componentType, const char* type, size_t count);
    uint32_t addVec3Accessor(const std::vector<glm::vec3>& values, bool withBounds);
    void useExtension(const std::string& name);

    nlohmann::json document_;
    std::vector<uint8_t> binary_;
};

}  // namespace raylab::assets
