#include "engine/measure/scene_hash.h"

#include <type_traits>

#include "engine/core/hash.h"

namespace raylab {
namespace {

/// Chains the hashes of what it is given. Structs go in field by field: their padding is no content.
class SceneHasher {
public:
    template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T> SceneHasher& operator<<(const T& value) {
        return addBytes(std::as_bytes(std::span(&value, 1)));
    }
    template <glm::length_t N, class T>
    SceneHasher& operator<<(const glm::vec<N, T>& value) {
        return addBytes(std::as_bytes(std::span(&value[0], static_cast<size_t>(N))));
    }
    SceneHasher& operator<<(const glm::mat4& value) { return addBytes(std::as_bytes(std::span(&value[0][0], 16))); }
    template <class T>
    SceneHasher& operator<<(const std::vector<T>& values) {
        *this << values.size();
        if constexpr (std::is_arithmetic_v<T>) return addBytes(std::as_bytes(std::span(values)));
        for (const T& value : values) *this << value;
        return *this;
    }
    template <glm::length_t N, class T>
    SceneHasher& operator<<(const std::vector<glm::vec<N, T>>& values) {
        static_assert(sizeof(glm::vec<N, T>) == N * sizeof(T));
        *this << values.size();
        return addBytes(std::as_bytes(std::span(values)));
    }
    template <class T>
    SceneHasher& operator<<(const SharedList<T>& values) {
        *this << values.size();
        for (const T& value : values) *this << value;
        return *this;
    }
    template <class T>
    SceneHasher& operator<<(const SharedOptional<T>& value) {
        *this << value.has_value();
        return value ? *this << *value : *this;
    }
    template <class T>
    SceneHasher& operator<<(const std::optional<T>& value) {
        *this << value.has_value();
        return value ? *this << *value : *this;
    }

    SceneHasher& operator<<(const Texture& t) {
        return *this << t.width << t.height << t.texels << t.srgb << t.wrapU << t.wrapV;
    }
    SceneHasher& operator<<(const PhongMaterial& p) {
        return *this << p.diffuse << p.specular << p.exponent << p.mirror << p.tint << p.reflection << p.ior;
    }
    SceneHasher& operator<<(const LobeTextures& t) {
        return *this << t.clearcoat << t.clearcoatRoughness << t.clearcoatNormal << t.clearcoatNormalScale << t.sheenColor
                     << t.sheenRoughness << t.anisotropy << t.specular << t.specularColor << t.transmission;
    }
    SceneHasher& operator<<(const Material& m) {
        return *this << m.baseColor << m.alpha << m.baseColorTexture << m.metallic << m.roughness
                     << m.metallicRoughnessTexture << m.normalTexture << m.normalScale << m.emission
                     << m.emissionTexture << m.alphaMode << m.alphaCutoff << m.transmission << m.ior << m.thin
                     << m.specular << m.doubleSided << m.specularColor << m.clearcoat << m.clearcoatRoughness
                     << m.sheenColor << m.sheenRoughness << m.anisotropy << m.anisotropyRotationRadians
                     << m.attenuationColor << m.attenuationDistance << m.lobeTextures << m.priority << m.phong;
    }
    SceneHasher& operator<<(const Quadric& q) { return *this << q.kind << q.radii << q.clipLow << q.clipHigh; }
    SceneHasher& operator<<(const Mesh& m) {
        return *this << m.material << m.positions << m.normals << m.uvs << m.tangents << m.triangles << m.quadrics;
    }
    SceneHasher& operator<<(const Instance& i) { return *this << i.mesh << i.objectToWorld << i.endToWorld; }
    SceneHasher& operator<<(const Camera& c) { return *this << c.position << c.target << c.up << c.fovYRadians; }
    SceneHasher& operator<<(const Light& l) {
        return *this << l.kind << l.position << l.direction << l.intensity << l.innerConeRadians << l.outerConeRadians
                     << l.radius << l.angularRadiusRadians << l.size << l.tangent;
    }
    SceneHasher& operator<<(const SunAndSky& s) { return *this << s.towardsSun << s.sunIrradiance << s.skyRadiance; }
    SceneHasher& operator<<(const Environment& e) {
        return *this << e.radiance.width << e.radiance.height << e.radiance.channels << e.radiance.pixels << e.parts;
    }
    SceneHasher& operator<<(const SkyDescription& s) {
        return *this << s.sunElevationRadians << s.sunAzimuthRadians << s.turbidity << s.scale;
    }

    const Hash128& hash() const { return hash_; }

private:
    SceneHasher& addBytes(std::span<const std::byte> bytes) {
        hash_ = hashBytes(bytes, hash_);
        return *this;
    }

    Hash128 hash_;
};

}  // namespace

std::string sceneHash(const Scene& scene) {
    SceneHasher hasher;
    hasher << scene.textures << scene.materials << scene.meshes << scene.instances << scene.cameras << scene.lights
           << scene.environment << scene.sky;
    return hashText(hasher.hash());
}

}  // namespace raylab
