#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/shared_list.h"
#include "engine/image/bitmap.h"

namespace raylab {

enum class Wrap : uint32_t { repeat = 0, clamp = 1, mirror = 2 };

/// An 8-bit RGBA image as a material reads it. `srgb` says how the colour channels are to be decoded (alpha is linear).
struct Texture {
    std::string name;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> texels;  ///< R in the lowest byte; rows from top to bottom
    bool srgb = false;
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
};

enum class AlphaMode : uint32_t { opaque = 0, mask = 1, blend = 2 };

constexpr int32_t kNoTexture = -1;

/// From this index of refraction on, a PhongMaterial is opaque: a metal (shaders/shared/scene.h has the kernels' number).
constexpr float kOpaqueIor = 10000.0f;

/// Material of Whitted's ray tracer: a diffuse part with a highlight, and a smooth part that mirrors and lets light through.
/// Colours are within 0 and 1. The base colour's texture of the Material multiplies `diffuse`.
struct PhongMaterial {
    glm::vec3 diffuse{0.8f};  ///< k_d
    glm::vec3 specular{0.0f};  ///< k_s, of the highlight
    float exponent = 1.0f;     ///< p of the highlight, 1 to 10,000
    glm::vec3 mirror{0.0f};    ///< multiplies mirrored light; of a metal: its reflectance at normal incidence
    glm::vec3 tint{0.0f};      ///< multiplies light at each surface that it passes through; black: opaque
    float reflection = 0.0f;   ///< r, fixed share of the light that is mirrored, where no Fresnel equations are asked for
    float ior = 1.5f;          ///< n; kOpaqueIor and above: a metal

    bool operator==(const PhongMaterial&) const = default;
};

/// Textures of what few materials have, each a factor of the Material's number of that name; indices as there.
struct LobeTextures {
    int32_t clearcoat = kNoTexture;           ///< R
    int32_t clearcoatRoughness = kNoTexture;  ///< G
    int32_t clearcoatNormal = kNoTexture;     ///< tangent space, +Y up; without: the coat's normal is the mesh's
    float clearcoatNormalScale = 1.0f;
    int32_t sheenColor = kNoTexture;      ///< RGB
    int32_t sheenRoughness = kNoTexture;  ///< A
    int32_t anisotropy = kNoTexture;      ///< RG direction in -1 to 1, which the rotation turns further; B strength
    int32_t specular = kNoTexture;        ///< A
    int32_t specularColor = kNoTexture;   ///< RGB
    int32_t transmission = kNoTexture;    ///< R
    int32_t thickness = kNoTexture;       ///< G; for rasterisers: kept, and not read

    bool operator==(const LobeTextures&) const = default;
};

/// Metallic-roughness material (glTF 2.0, appendix B) with transmission. Colours are linear sRGB primaries.
/// Texture indices refer to Scene::textures; each texture multiplies its factor.
struct Material {
    std::string name;
    glm::vec3 baseColor{1.0f};
    float alpha = 1.0f;
    int32_t baseColorTexture = kNoTexture;  ///< RGB colour, A alpha
    float metallic = 0.0f;
    float roughness = 1.0f;                         ///< perceptual; alpha_GGX = roughness^2
    int32_t metallicRoughnessTexture = kNoTexture;  ///< G roughness, B metallic
    int32_t normalTexture = kNoTexture;             ///< tangent space, +Y up
    float normalScale = 1.0f;
    glm::vec3 emission{0.0f};  ///< radiance, strength included
    int32_t emissionTexture = kNoTexture;
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;
    float transmission = 0.0f;  ///< share of light that enters the surface instead of being scattered back
    float ior = 1.5f;
    bool thin = true;          ///< transmission without refraction: a sheet, not the boundary of a volume
    float specular = 1.0f;     ///< scales the dielectric reflection; 0 makes the base purely Lambertian
    bool doubleSided = false;  ///< both faces emit; other shading is two-sided always
    glm::vec3 specularColor{1.0f};  ///< tints the dielectric reflection at normal incidence
    float clearcoat = 0.0f;         ///< share of the surface below a layer of ior 1.5
    float clearcoatRoughness = 0.0f;
    glm::vec3 sheenColor{0.0f};  ///< black: none
    float sheenRoughness = 0.0f;
    float anisotropy = 0.0f;                 ///< 0 to 1: the highlight is stretched along the tangent
    float anisotropyRotationRadians = 0.0f;  ///< of that direction from the tangent, towards the bitangent
    glm::vec3 attenuationColor{1.0f};        ///< what is left of white light after attenuationDistance inside the volume
    float attenuationDistance = std::numeric_limits<float>::infinity();  ///< scene units, positive
    float thickness = 1.0f;  ///< of a volume, above 0, as a rasteriser takes it: kept, and not read
    LobeTextures lobeTextures;
    uint32_t priority = 0;  ///< of volumes that overlap: the one of the highest priority is there, the others are not
    std::optional<PhongMaterial> phong;  ///< nothing: derived from the above

    bool operator==(const Material&) const = default;
};

enum class QuadricKind : uint32_t { ellipsoid = 0, cylinder = 1, cone = 2, hyperboloid = 3, paraboloid = 4 };

/// A surface of the second degree around the z axis, with X = x / radii.x, Y = y / radii.y, Z = z / radii.z:
///   ellipsoid X^2 + Y^2 + Z^2 = 1, cylinder X^2 + Y^2 = 1, cone X^2 + Y^2 = Z^2,
///   hyperboloid (of one sheet) X^2 + Y^2 - Z^2 = 1, elliptic paraboloid X^2 + Y^2 = Z.
/// What lies outside clipLow <= z <= clipHigh is cut away and the surface is open there. All numbers are finite, the
/// radii positive, clipLow < clipHigh. Another axis is a matter of the instance's transform.
struct Quadric {
    QuadricKind kind = QuadricKind::ellipsoid;
    glm::vec3 radii{1.0f};
    float clipLow = -1.0f;
    float clipHigh = 1.0f;

    bool operator==(const Quadric&) const = default;
};

/// Triangles of one material, or quadrics of one material: one of the two lists is empty. All per-vertex arrays are
/// either empty or as long as `positions`. A primitive's id is its index in its list.
struct Mesh {
    std::string name;
    uint32_t material = 0;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   ///< unit; empty: flat shading by the geometric normal
    std::vector<glm::vec2> uvs;       ///< v grows downwards, as in glTF: (0,0) is the first texel of the first row
    std::vector<glm::vec4> tangents;  ///< unit, w = handedness of the bitangent, as in glTF
    std::vector<glm::uvec3> triangles;
    std::vector<Quadric> quadrics;
};

struct Instance {
    std::string name;
    uint32_t mesh = 0;
    glm::mat4 objectToWorld{1.0f};                        ///< where the shutter opens
    std::optional<glm::mat4> endToWorld = std::nullopt;   ///< the same where it closes; nothing: the instance stands still

    bool operator==(const Instance&) const = default;
};

struct Camera {
    std::string name;
    glm::vec3 position{0.0f, 0.0f, 5.0f};
    glm::vec3 target{0.0f};  ///< any point on the axis of view
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float fovYRadians = 0.8f;

    bool operator==(const Camera&) const = default;
};

enum class LightKind : uint32_t { point = 0, directional = 1, spot = 2, sphere = 3, disc = 4, rectangle = 5 };

/// A light that is no surface of the scene: punctual (KHR_lights_punctual), or of a shape that sends the same radiance
/// everywhere; discs and rectangles on the side that `direction` points to. Shapes are seen by path tracing, and let rays
/// pass; integrators that know punctual lights alone take them as points at their centre.
struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    glm::vec3 position{0.0f};
    glm::vec3 direction{0.0f, -1.0f, 0.0f};  ///< unit, the way the light travels
    glm::vec3 intensity{1.0f};  ///< radiant intensity, along the direction; directional: irradiance on a facing plane
    float innerConeRadians = 0.0f;
    float outerConeRadians = 0.7853982f;
    float radius = 0.0f;               ///< sphere, disc: above 0
    float angularRadiusRadians = 0.0f; ///< directional: of the disc that the light comes from; 0: from one direction
    glm::vec2 size{0.0f};              ///< rectangle: width and height, above 0
    glm::vec3 tangent{1.0f, 0.0f, 0.0f};  ///< rectangle: unit, along its width, orthogonal to the direction

    bool operator==(const Light&) const = default;
};

/// What a computed sky is made of, for integrators that take no light from a map.
struct SunAndSky {
    glm::vec3 towardsSun{0.0f, 1.0f, 0.0f};  ///< unit
    glm::vec3 sunIrradiance{0.0f};           ///< on a plane that faces the sun
    glm::vec3 skyRadiance{0.0f};  ///< mean over all directions, without the sun
};

/// Radiance from infinitely far away, as a latitude-longitude map: row 0 is up (+Y), column 0 looks along +Z, the middle along -Z... see
/// shaders/lib/environment.glsl for the one mapping.
struct Environment {
    Bitmap radiance;  ///< three channels
    std::optional<SunAndSky> parts{};  ///< of a computed sky, whose map has both in it
};

/// Sun and clear sky above a scene that has no radiance map.
struct SkyDescription {
    float sunElevationRadians = 0.7853982f;  ///< above the horizon (the XZ plane)
    float sunAzimuthRadians = 0.0f;          ///< clockwise as seen from above: 0 at -Z, pi/2 at +X
    float turbidity = 2.5f;                  ///< 1 (pure air) to 10 (haze)
    float scale = 1.0f;                      ///< multiplies the radiance

    bool operator==(const SkyDescription&) const = default;
};

/// Everything that a file says, as plain data. Indices are checked by the importer: a Scene never points outside
/// itself. Copies share what is large (meshes, texels, the radiance map), so that a copy costs about 100 bytes an instance.
struct Scene {
    std::string name;
    SharedList<Texture> textures;
    std::vector<Material> materials;
    SharedList<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    SharedOptional<Environment> environment;
    std::optional<SkyDescription> sky;
    std::vector<std::string> warnings;  ///< what was missing or put right, a sentence each
};

}  // namespace raylab
