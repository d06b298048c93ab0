#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/import.h"
#include "engine/scene/texture_slots.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"

/// Scene files written by hand, and the scenes that others made.
namespace raylab::importtest {
namespace fs = std::filesystem;

using support::ScratchFolder;

inline const fs::path kScenes = support::sharedScenes();

#define SKIP_WITHOUT_SCENE(file) \
    if (!fs::exists(file)) GTEST_SKIP() << (file) << " is absent: the shared scenes folder is not on this machine"

inline bool anyContains(const std::vector<std::string>& texts, const std::string& part) {
    return std::any_of(texts.begin(), texts.end(),
                       [&part](const std::string& text) { return text.find(part) != std::string::npos; });
}

inline std::string joined(const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& text : texts) all += text + "\n";
    return all;
}

/// what() of the Error that importScene throws, or "" where it throws none.
inline std::string errorOf(const fs::path& file) {
    try {
        importScene(file);
    } catch (const Error& error) {
        EXPECT_EQ(error.exitCode(), ExitCode::badInput);
        return error.what();
    }
    return "";
}

template <class T>
std::string bytesOf(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// A glTF document under construction, its one buffer beside it.
class Gltf {
public:
    nlohmann::json json;
    std::string buffer;

    Gltf() {
        json["asset"]["version"] = "2.0";
        json["scene"] = 0;
        json["scenes"] = {{{"nodes", {0}}}};
        json["nodes"] = {{{"mesh", 0}}};
    }

    /// Index of a new accessor over a new view with `values`.
    template <class T>
    size_t accessor(const std::vector<T>& values, int componentType, const std::string& type, size_t count,
                    bool normalized = false) {
        buffer.resize((buffer.size() + 3) / 4 * 4);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", values.size() * sizeof(T)}});
        buffer += bytesOf(values);
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", componentType},
                                     {"type", type},
                                     {"count", count},
                                     {"normalized", normalized}});
        return json["accessors"].size() - 1;
    }
    size_t positions(const std::vector<float>& xyz) { return accessor(xyz, 5126, "VEC3", xyz.size() / 3); }
    size_t indices(const std::vector<uint16_t>& values) { return accessor(values, 5123, "SCALAR", values.size()); }

    /// A mesh with one primitive; its index.
    size_t mesh(const nlohmann::json& primitive) {
        json["meshes"].push_back({{"primitives", nlohmann::json::array({primitive})}});
        return json["meshes"].size() - 1;
    }
    /// The triangle (0,0,0), (1,0,0), (0,1,0) with texture coordinates (0,0), (1,0), (0,1).
    nlohmann::json trianglePrimitive() {
        const size_t position = positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
        const size_t uv = accessor<float>({0, 0, 1, 0, 0, 1}, 5126, "VEC2", 3);
        return {{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}}};
    }

    std::string text() const {
        nlohmann::json document = json;
        if (!buffer.empty()) document["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", buffer.size()}}};
        return document.dump();
    }
    fs::path write(const ScratchFolder& folder) const {
        folder.write("scene.bin", buffer);
        return folder.write("scene.gltf", text());
    }
    /// The same as a GLB.
    std::string glb() const {
        nlohmann::json document = json;
        document["buffers"] = {{{"byteLength", buffer.size()}}};
        std::string jsonChunk = document.dump();
        jsonChunk.resize((jsonChunk.size() + 3) / 4 * 4, ' ');
        std::string binChunk = buffer;
        binChunk.resize((binChunk.size() + 3) / 4 * 4, '\0');
        const auto u32 = [](size_t value) { return bytesOf(std::vector<uint32_t>{static_cast<uint32_t>(value)}); };
        return "glTF" + u32(2) + u32(12 + 8 + jsonChunk.size() + 8 + binChunk.size()) + u32(jsonChunk.size()) + "JSON" +
               jsonChunk + u32(binChunk.size()) + std::string("BIN\0", 4) + binChunk;
    }
};

inline void expectNear(glm::vec3 a, glm::vec3 b, float tolerance = 1e-6f) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

/// Every index exists and every number is finite: what importScene promises.
inline void expectSound(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        ASSERT_FALSE(mesh.triangles.empty() && mesh.quadrics.empty()) << mesh.name;
        ASSERT_LT(mesh.material, scene.materials.size());
        for (const glm::uvec3& t : mesh.triangles)
            ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size()) << mesh.name;
        for (const glm::vec3& p : mesh.positions)
            ASSERT_LE(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1e18f);
        ASSERT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
        ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size());
        ASSERT_TRUE(mesh.tangents.empty() || mesh.tangents.size() == mesh.positions.size());
        for (const glm::vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f) << mesh.name;
        for (const glm::vec4& t : mesh.tangents) ASSERT_NEAR(glm::length(glm::vec3(t)), 1.0f, 1e-4f) << mesh.name;
        for (const glm::vec2& uv : mesh.uvs) ASSERT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y)) << mesh.name;
    }
    const auto textureCount = static_cast<int32_t>(scene.textures.size());
    for (const Material& material : scene.materials)
        for (const int32_t* const texture : textureSlots(material)) ASSERT_LT(*texture, textureCount) << material.name;
    for (const Instance& instance : scene.instances) ASSERT_LT(instance.mesh, scene.meshes.size());
}

}  // namespace raylab::importtest
