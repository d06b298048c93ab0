#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/alias_table.h"
#include "engine/scene/scene.h"
#include "shaders/shared/scene.h"

namespace raylab {

/// Meshes and instances as the kernels shade them.
struct GeometryData {
    std::vector<shared::InstanceData> instances;
    std::vector<shared::TriangleData> triangles;  ///< of all meshes, one after another
    std::vector<shared::VertexData> vertices;
    std::vector<shared::QuadricData> quadrics;  ///< of all meshes, one after another
};

/// Materials and textures. Level 0 of a texture is followed by its smaller levels.
struct MaterialTables {
    std::vector<shared::MaterialData> materials;
    std::vector<shared::TextureData> textures;
    std::vector<uint32_t> texels;
    std::vector<uint32_t> means;  ///< of each texture: the one texel of its smallest level
};

/// Way to an emissive triangle in the tree over lights, and 1 / area.
struct LightTrail {
    uint32_t trail = 0;
    float inverseArea = 0.0f;
};

/// Lights, with what next event estimation needs to choose among them.
struct LightTables {
    std::vector<shared::EmissiveData> emissive;
    std::vector<shared::PunctualData> punctual;
    std::vector<glm::vec4> environment;  ///< radiance, relative density; empty: constant
    std::vector<AliasEntry> environmentAlias;
    uint32_t environmentWidth = 0;
    uint32_t environmentHeight = 0;
    glm::vec3 environmentConstant{0.0f};
    double environmentMean = 0.0;              ///< over the map, of its luminance by the sine of the polar angle
    std::vector<shared::LightNodeData> nodes;  ///< of the tree over lights; empty: none
    std::vector<LightTrail> trails;            ///< of the lights of a shape, then of the primitives of instances that emit
    std::vector<uint32_t> firstTrail;          ///< of each instance
    glm::vec3 gridOrigin{0.0f};                ///< of the nodes' boxes
    glm::vec3 gridStep{0.0f};
    uint32_t shapedCount = 0;   ///< of the punctual lights: the first
    uint32_t sunDiscCount = 0;  ///< of the punctual lights: the last
    float emissiveTotal = 0.0f;  ///< sum of area x weight
    float shareEmissive = 0.0f;  ///< with a tree: of all its lights, and sharePunctual is that of directional lights
    float sharePunctual = 0.0f;
    float shareEnvironment = 0.0f;
};

/// Octahedral encoding, 2 x 16 bits signed normalised (Cigolle et al., JCGT 3(2), 2014).
uint32_t encodeNormal(glm::vec3 unit);

/// As encodeNormal with the handedness in the lowest bit.
uint32_t encodeTangent(glm::vec4 tangent);

GeometryData packGeometry(const Scene& scene);

/// Where instances are when the shutter closes; empty where none moves.
std::vector<shared::MotionData> packMotion(const Scene& scene);

/// The instances of packGeometry() alone.
std::vector<shared::InstanceData> packInstances(const Scene& scene);

/// Throws Error where the textures together have more texels than 32 bits address.
MaterialTables packMaterials(const Scene& scene);

/// The materials of packMaterials() alone.
std::vector<shared::MaterialData> packMaterialData(const Scene& scene);

/// What materials say to the Phong model, one a material; isGiven = 0 where they say nothing.
std::vector<shared::PhongData> packPhong(const Scene& scene);

/// The lobes of materials that few have, one entry a material.
std::vector<shared::LobeData> packLobes(const Scene& scene);
std::vector<shared::LobeTextureData> packLobeTextures(const Scene& scene);

/// A material's index of a texture as the kernels have it.
uint32_t textureIndex(int32_t texture);

/// How next event estimation chooses: by a tree over lights; in proportion to the power that lights send out; or uniformly:
/// kinds of light, punctual lights and the area of lamps evenly. A tree wants two lights at least, else the choice is by power.
enum class LightChoice { automatic, tree, power, uniform };

struct LightConfig {
    LightChoice choice = LightChoice::automatic;
    /// For integrators that know punctual lights alone: shapes are points at their centre, and a computed sky's sun is one of
    /// the lights.
    bool allPunctual = false;
};

/// A light as the kernels sample it, without its probability; or with its shape shrunk to a point.
shared::PunctualData packLight(const Light& light);
shared::PunctualData packAsPoint(const Light& light);

/// Fills what `lights` holds of a tree over its emissive triangles, whose materials emit the luminance `emitted`, and its
/// punctual lights but the directional ones, which stand last.
void packLightTree(const Scene& scene, std::span<const float> emitted, LightTables& lights);

/// Whether packLights() adds the sun of the scene's sky to the punctual lights.
bool hasSunLight(const Scene& scene, const LightConfig& config);

/// `materials` gets its emission weights; of its textures their means alone are read. `sceneRadius` weighs lights at
/// infinity against the others. `known`: tables with the same environment, whose arrays are then not filled again.
LightTables packLights(const Scene& scene, float sceneRadius, MaterialTables& materials, const LightConfig& config = {},
                       const LightTables* known = nullptr);

}  // namespace raylab
