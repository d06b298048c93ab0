#pragma once

#include <cstdint>
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
    float emissiveTotal = 0.0f;  ///< sum of area x weight
    float shareEmissive = 0.0f;
    float sharePunctual = 0.0f;
    float shareEnvironment = 0.0f;
};

/// Octahedral encoding, 2 x 16 bits signed normalised (Cigolle et al., JCGT 3(2), 2014).
uint32_t encodeNormal(glm::vec3 unit);

/// As encodeNormal with the handedness in the lowest bit.
uint32_t encodeTangent(glm::vec4 tangent);

GeometryData packGeometry(const Scene& scene);

/// Throws Error where the textures together have more texels than 32 bits address.
MaterialTables packMaterials(const Scene& scene);

/// What materials say to the Phong model, one a material; isGiven = 0 where they say nothing.
std::vector<shared::PhongData> packPhong(const Scene& scene);

/// How next event estimation chooses: in proportion to the power that lights send out; or uniformly: kinds of light,
/// punctual lights and the area of lamps evenly.
enum class LightChoice { power, uniform };

/// `materials` gets its emission weights. `sceneRadius` weighs lights at infinity against the others.
LightTables packLights(const Scene& scene, float sceneRadius, MaterialTables& materials, LightChoice choice = LightChoice::power);

}  // namespace raylab
