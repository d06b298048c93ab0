#pragma once

#include <bit>

#include "import_support.h"

/// Scenes compared bit for bit: -0 is not 0 here, and a NaN equals itself.
namespace raylab::importtest {

template <class T>
void expectSameBits(const std::vector<T>& a, const std::vector<T>& b, const std::string& what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    for (size_t i = 0; i < a.size(); ++i)
        ASSERT_EQ(std::memcmp(&a[i], &b[i], sizeof(T)), 0) << what << " " << i << " of " << a.size();
}

template <class T>
void expectSameBits(const T& a, const T& b, const std::string& what) {
    EXPECT_EQ(std::memcmp(&a, &b, sizeof(T)), 0) << what;
}

inline void expectSame(const Texture& a, const Texture& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.width, b.width) << a.name;
    EXPECT_EQ(a.height, b.height) << a.name;
    EXPECT_EQ(a.srgb, b.srgb) << a.name;
    EXPECT_EQ(a.wrapU, b.wrapU) << a.name;
    EXPECT_EQ(a.wrapV, b.wrapV) << a.name;
    expectSameBits(a.texels, b.texels, "texels of " + a.name);
}

inline void expectSame(const Material& a, const Material& b) {
    EXPECT_EQ(a.name, b.name);
    expectSameBits(a.baseColor, b.baseColor, a.name + " baseColor");
    expectSameBits(a.emission, b.emission, a.name + " emission");
    const auto numbers = [](const Material& m) {
        return std::vector<float>{m.alpha,       m.metallic,     m.roughness, m.normalScale,
                                  m.alphaCutoff, m.transmission, m.ior,       m.specular};
    };
    expectSameBits(numbers(a), numbers(b),
                   a.name + " alpha, metallic, roughness, normalScale, cutoff, transmission...");
    const auto lobes = [](const Material& m) {
        return std::vector<float>{m.specularColor.x,    m.specularColor.y, m.specularColor.z,
                                  m.sheenColor.x,       m.sheenColor.y,    m.sheenColor.z,
                                  m.attenuationColor.x, m.attenuationColor.y, m.attenuationColor.z,
                                  m.clearcoat,          m.clearcoatRoughness, m.sheenRoughness,
                                  m.anisotropy,         m.anisotropyRotationRadians, m.attenuationDistance};
    };
    expectSameBits(lobes(a), lobes(b), a.name + " specular colour, sheen colour, attenuation, coat, sheen, anisotropy...");
    expectSameBits(a.lobeTextures, b.lobeTextures, a.name + " textures of lobes");
    expectSameBits(a.thickness, b.thickness, a.name + " thickness");
    EXPECT_EQ(a.priority, b.priority) << a.name;
    EXPECT_EQ(a.baseColorTexture, b.baseColorTexture) << a.name;
    EXPECT_EQ(a.metallicRoughnessTexture, b.metallicRoughnessTexture) << a.name;
    EXPECT_EQ(a.normalTexture, b.normalTexture) << a.name;
    EXPECT_EQ(a.emissionTexture, b.emissionTexture) << a.name;
    EXPECT_EQ(a.alphaMode, b.alphaMode) << a.name;
    EXPECT_EQ(a.thin, b.thin) << a.name;
    EXPECT_EQ(a.doubleSided, b.doubleSided) << a.name;
    ASSERT_EQ(a.phong.has_value(), b.phong.has_value()) << a.name;
    if (a.phong) expectSameBits(*a.phong, *b.phong, a.name + " phong");
}

/// An attribute at the corners of the triangles, in their order. Some versions of Assimp (5.3 of Ubuntu 24.04) number the
/// vertices of a primitive anew, by their first use; a corner keeps its values.
template <class T>
std::vector<T> atCorners(const Mesh& mesh, const std::vector<T>& attribute) {
    std::vector<T> values;
    if (attribute.empty()) return values;
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int c = 0; c < 3; ++c) values.push_back(attribute.at(triangle[c]));
    return values;
}

inline void expectSame(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.material, b.material) << a.name;
    EXPECT_EQ(a.positions.size(), b.positions.size()) << a.name;
    const auto expectSameCorners = [&](const auto& ofA, const auto& ofB, const char* what) {
        expectSameBits(atCorners(a, ofA), atCorners(b, ofB), a.name + what);
    };
    expectSameCorners(a.positions, b.positions, " positions");
    expectSameCorners(a.normals, b.normals, " normals");
    expectSameCorners(a.uvs, b.uvs, " uvs");
    expectSameCorners(a.tangents, b.tangents, " tangents");
    expectSameBits(a.quadrics, b.quadrics, a.name + " quadrics");
}

inline void expectSame(const Instance& a, const Instance& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.mesh, b.mesh) << a.name;
    expectSameBits(a.objectToWorld, b.objectToWorld, a.name + " objectToWorld");
    ASSERT_EQ(a.endToWorld.has_value(), b.endToWorld.has_value()) << a.name;
    if (a.endToWorld) expectSameBits(*a.endToWorld, *b.endToWorld, a.name + " endToWorld");
}

inline void expectSame(const Camera& a, const Camera& b) {
    EXPECT_EQ(a.name, b.name);
    expectSameBits(a.position, b.position, a.name + " position");
    expectSameBits(a.target, b.target, a.name + " target");
    expectSameBits(a.up, b.up, a.name + " up");
    expectSameBits(a.fovYRadians, b.fovYRadians, a.name + " fovY");
}

inline void expectSame(const Light& a, const Light& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.kind, b.kind) << a.name;
    expectSameBits(a.position, b.position, a.name + " position");
    expectSameBits(a.direction, b.direction, a.name + " direction");
    expectSameBits(a.intensity, b.intensity, a.name + " intensity");
    expectSameBits(a.innerConeRadians, b.innerConeRadians, a.name + " inner cone");
    expectSameBits(a.outerConeRadians, b.outerConeRadians, a.name + " outer cone");
    expectSameBits(a.radius, b.radius, a.name + " radius");
    expectSameBits(a.angularRadiusRadians, b.angularRadiusRadians, a.name + " angular radius");
    expectSameBits(a.size, b.size, a.name + " size");
    expectSameBits(a.tangent, b.tangent, a.name + " tangent");
}

template <class List>
void expectSameList(const List& a, const List& b, const char* what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    for (size_t i = 0; i < a.size(); ++i) {
        SCOPED_TRACE(std::string(what) + " " + std::to_string(i));
        expectSame(a[i], b[i]);
    }
}

/// All but the warnings.
inline void expectSameScene(const Scene& a, const Scene& b) {
    EXPECT_EQ(a.name, b.name);
    expectSameList(a.textures, b.textures, "textures");
    expectSameList(a.materials, b.materials, "materials");
    expectSameList(a.meshes, b.meshes, "meshes");
    expectSameList(a.instances, b.instances, "instances");
    expectSameList(a.cameras, b.cameras, "cameras");
    expectSameList(a.lights, b.lights, "lights");
    ASSERT_EQ(a.environment.has_value(), b.environment.has_value());
    if (a.environment) {
        EXPECT_EQ(a.environment->radiance.width, b.environment->radiance.width);
        EXPECT_EQ(a.environment->radiance.height, b.environment->radiance.height);
        expectSameBits(a.environment->radiance.pixels, b.environment->radiance.pixels, "environment");
    }
    ASSERT_EQ(a.sky.has_value(), b.sky.has_value());
    if (a.sky) expectSameBits(*a.sky, *b.sky, "sky");
}

}  // namespace raylab::importtest
