#include "engine/scene/import_mesh.h"

#include <assimp/mesh.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "engine/scene/mesh_shading.h"
#include "engine/scene/polygon.h"

namespace raylab {
namespace {

constexpr uint32_t kUnassigned = std::numeric_limits<uint32_t>::max();

glm::vec3 toVec3(const aiVector3D& v) { return glm::vec3(v.x, v.y, v.z); }

bool isFinite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// False for NaN too.
bool isUsable(glm::vec3 p) {
    return std::abs(p.x) <= kLargestSceneCoordinate && std::abs(p.y) <= kLargestSceneCoordinate &&
           std::abs(p.z) <= kLargestSceneCoordinate;
}

/// The face's corners where all of them can be used; else empty, and counted.
std::span<const uint32_t> usableCorners(const aiFace& face, const std::vector<bool>& usable, MeshRepairs& repairs) {
    const std::span<const uint32_t> corners(face.mIndices, face.mNumIndices);
    if (corners.size() < 3) {
        ++repairs.notTriangles;
        return {};
    }
    if (std::any_of(corners.begin(), corners.end(), [&usable](uint32_t i) { return i >= usable.size(); })) {
        repairs.missingVertices += corners.size() - 2;
        return {};
    }
    if (!std::all_of(corners.begin(), corners.end(), [&usable](uint32_t i) { return usable[i]; })) {
        repairs.nonFiniteVertices += corners.size() - 2;
        return {};
    }
    return corners;
}

void copyTriangles(const aiMesh& source, Mesh& mesh, MeshRepairs& repairs) {
    std::vector<bool> usable(mesh.positions.size());
    for (size_t i = 0; i < usable.size(); ++i) usable[i] = isUsable(mesh.positions[i]);
    mesh.triangles.reserve(source.mNumFaces);
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
        const std::span<const uint32_t> corners = usableCorners(source.mFaces[f], usable, repairs);
        if (corners.size() == 3)
            mesh.triangles.emplace_back(corners[0], corners[1], corners[2]);
        else if (corners.size() > 3)
            triangulatePolygon(corners, mesh.positions, mesh.triangles);
    }
}

/// Scene counts v downwards.
void copyUvs(const aiMesh& source, UvForm form, Mesh& mesh, MeshRepairs& repairs) {
    if (!source.HasTextureCoords(0)) return;
    mesh.uvs.resize(mesh.positions.size());
    for (size_t i = 0; i < mesh.uvs.size(); ++i) {
        const aiVector3D& given = source.mTextureCoords[0][i];
        const glm::vec2 uv(given.x, form == UvForm::upwards ? 1.0f - given.y : given.z);
        const bool finite = std::isfinite(uv.x) && std::isfinite(uv.y);
        repairs.uvs += !finite;
        mesh.uvs[i] = finite ? uv : glm::vec2(0.0f);
    }
}

/// `length` is that of `v` and not 0.
glm::vec3 normalized(glm::vec3 v, float length) { return isUnit(v) ? v : v / length; }

void copyNormals(const aiMesh& source, Mesh& mesh, MeshRepairs& repairs) {
    mesh.normals.resize(mesh.positions.size());
    std::vector<size_t> bad;
    for (size_t i = 0; i < mesh.normals.size(); ++i) {
        const glm::vec3 normal = toVec3(source.mNormals[i]);
        const float length = glm::length(normal);
        const bool usable = std::isfinite(length) && length > 1e-18f;
        mesh.normals[i] = usable ? normalized(normal, length) : glm::vec3(0.0f, 0.0f, 1.0f);
        if (!usable) bad.push_back(i);
    }
    if (bad.empty()) return;
    repairs.normals += bad.size();
    const std::vector<glm::vec3> geometric = angleWeightedNormals(mesh.positions, mesh.triangles);
    for (const size_t i : bad) mesh.normals[i] = geometric[i];
}

/// All or nothing: one unusable tangent and they are computed anew where a material asks for them.
void copyTangents(const aiMesh& source, Mesh& mesh) {
    mesh.tangents.resize(mesh.positions.size());
    for (size_t i = 0; i < mesh.tangents.size(); ++i) {
        const glm::vec3 tangent = toVec3(source.mTangents[i]);
        const glm::vec3 bitangent = toVec3(source.mBitangents[i]);
        const float length = glm::length(tangent);
        if (!isFinite(tangent) || !isFinite(bitangent) || !(length > 1e-18f) || !std::isfinite(length)) {
            mesh.tangents.clear();
            return;
        }
        const float side = glm::dot(glm::cross(mesh.normals[i], tangent), bitangent);
        mesh.tangents[i] = glm::vec4(normalized(tangent, length), side < 0.0f ? -1.0f : 1.0f);
    }
}

template <class T>
void gather(std::vector<T>& values, const std::vector<uint32_t>& kept) {
    if (values.empty()) return;
    std::vector<T> result(kept.size());
    for (size_t i = 0; i < kept.size(); ++i) result[i] = values[kept[i]];
    values = std::move(result);
}

void keepVertices(Mesh& mesh, const std::vector<uint32_t>& kept) {
    gather(mesh.positions, kept);
    gather(mesh.normals, kept);
    gather(mesh.uvs, kept);
    gather(mesh.tangents, kept);
}

/// All attributes of a vertex, bit for bit.
using VertexKey = std::array<uint32_t, 12>;

VertexKey vertexKey(const Mesh& mesh, size_t i) {
    VertexKey key{};
    std::memcpy(key.data(), &mesh.positions[i], sizeof(glm::vec3));
    if (!mesh.normals.empty()) std::memcpy(key.data() + 3, &mesh.normals[i], sizeof(glm::vec3));
    if (!mesh.uvs.empty()) std::memcpy(key.data() + 6, &mesh.uvs[i], sizeof(glm::vec2));
    if (!mesh.tangents.empty()) std::memcpy(key.data() + 8, &mesh.tangents[i], sizeof(glm::vec4));
    return key;
}

size_t hashOf(const VertexKey& key) {
    uint64_t hash = 0x9E3779B97F4A7C15ull;
    for (const uint32_t word : key) {
        hash = (hash ^ word) * 0xFF51AFD7ED558CCDull;
        hash ^= hash >> 32;
    }
    return hash;
}

}  // namespace

MeshRepairs& MeshRepairs::operator+=(const MeshRepairs& other) {
    notTriangles += other.notTriangles;
    missingVertices += other.missingVertices;
    nonFiniteVertices += other.nonFiniteVertices;
    normals += other.normals;
    uvs += other.uvs;
    return *this;
}

void MeshRepairs::report(std::vector<std::string>& warnings) const {
    const auto say = [&warnings](size_t count, const std::string& what) {
        if (count > 0) warnings.push_back(what + ": " + std::to_string(count));
    };
    say(notTriangles, "points and lines left out, only triangles are rendered");
    say(missingVertices, "triangles left out that name vertices which do not exist");
    say(nonFiniteVertices, "triangles left out with a vertex that is not finite or beyond 1e18");
    say(normals, "normals that were zero or not finite, computed from the triangles");
    say(uvs, "texture coordinates that were not finite, set to 0");
}

bool isUnit(glm::dvec3 v) { return std::abs(glm::dot(v, v) - 1.0) <= 1e-6; }

Mesh convertMesh(const aiMesh& source, const MeshOptions& options, MeshRepairs& repairs) {
    Mesh mesh;
    mesh.name = source.mName.C_Str();
    mesh.positions.resize(source.mNumVertices);
    for (size_t i = 0; i < mesh.positions.size(); ++i) mesh.positions[i] = toVec3(source.mVertices[i]);
    copyTriangles(source, mesh, repairs);
    copyUvs(source, options.uvs, mesh, repairs);
    if (source.HasNormals() && options.normals != NormalRule::flat) copyNormals(source, mesh, repairs);
    if (!mesh.normals.empty() && source.HasTangentsAndBitangents()) copyTangents(source, mesh);
    compactVertices(mesh);
    if (options.weld) weldVertices(mesh);
    if (mesh.normals.empty() && options.normals == NormalRule::smooth)
        mesh.normals = angleWeightedNormals(mesh.positions, mesh.triangles);
    return mesh;
}

void weldVertices(Mesh& mesh) {
    // Open addressing at half load; a slot holds the index of a vertex that was kept.
    std::vector<uint32_t> slots(std::bit_ceil(mesh.positions.size() * 2 + 1), kUnassigned);
    std::vector<uint32_t> kept;
    std::vector<uint32_t> newIndex(mesh.positions.size());
    for (uint32_t i = 0; i < mesh.positions.size(); ++i) {
        const VertexKey key = vertexKey(mesh, i);
        size_t slot = hashOf(key) & (slots.size() - 1);
        while (slots[slot] != kUnassigned && vertexKey(mesh, kept[slots[slot]]) != key)
            slot = (slot + 1) & (slots.size() - 1);
        if (slots[slot] == kUnassigned) {
            slots[slot] = static_cast<uint32_t>(kept.size());
            kept.push_back(i);
        }
        newIndex[i] = slots[slot];
    }
    for (glm::uvec3& triangle : mesh.triangles)
        triangle = glm::uvec3(newIndex[triangle.x], newIndex[triangle.y], newIndex[triangle.z]);
    keepVertices(mesh, kept);
}

void compactVertices(Mesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const glm::uvec3& triangle : mesh.triangles) used[triangle.x] = used[triangle.y] = used[triangle.z] = true;
    std::vector<uint32_t> kept;
    std::vector<uint32_t> newIndex(mesh.positions.size(), kUnassigned);
    for (uint32_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        newIndex[i] = static_cast<uint32_t>(kept.size());
        kept.push_back(i);
    }
    if (kept.size() == mesh.positions.size()) return;
    for (glm::uvec3& triangle : mesh.triangles)
        triangle = glm::uvec3(newIndex[triangle.x], newIndex[triangle.y], newIndex[triangle.z]);
    keepVertices(mesh, kept);
}

bool wantsTangents(const Material& material) {
    return material.normalTexture != kNoTexture || material.lobeTextures.clearcoatNormal != kNoTexture ||
           material.anisotropy > 0.0f;
}

void ensureTangents(Mesh& mesh) {
    if (mesh.uvs.empty() || !mesh.tangents.empty()) return;
    const std::vector<glm::vec3> geometric =
        mesh.normals.empty() ? angleWeightedNormals(mesh.positions, mesh.triangles) : std::vector<glm::vec3>();
    mesh.tangents =
        vertexTangents(mesh.positions, mesh.normals.empty() ? geometric : mesh.normals, mesh.uvs, mesh.triangles);
}

}  // namespace raylab
