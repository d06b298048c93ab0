#include "assets/generate/gltf_writer.h"

#include <array>
#include <cstring>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

namespace raylab::assets {
namespace {

using nlohmann::json;

constexpr int kFloat = 5126;
constexpr int kUint32 = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kNoTarget = 0;

json toJson(glm::vec3 v) { return json::array({v.x, v.y, v.z}); }

json matrixToJson(const glm::mat4& m) {
    json result = json::array();
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) result.push_back(m[column][row]);
    }
    return result;
}

void padTo4(std::vector<uint8_t>& bytes, uint8_t filler) {
    while (bytes.size() % 4 != 0) bytes.push_back(filler);
}

json pbrToJson(const MaterialSpec& spec) {
    json pbr = {{"baseColorFactor", {spec.baseColor.x, spec.baseColor.y, spec.baseColor.z, 1.0f}},
                {"metallicFactor", spec.metallic},
                {"roughnessFactor", spec.roughness}};
    if (spec.baseColorTexture) pbr["baseColorTexture"] = {{"index", *spec.baseColorTexture}};
    if (spec.metallicRoughnessTexture) pbr["metallicRoughnessTexture"] = {{"index", *spec.metallicRoughnessTexture}};
    return pbr;
}

json extensionsToJson(const MaterialSpec& spec) {
    json extensions = json::object();
    const float strength = glm::max(spec.emission.x, glm::max(spec.emission.y, spec.emission.z));
    if (strength > 1.0f) extensions["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
    if (spec.transmission > 0.0f) {
        extensions["KHR_materials_transmission"] = {{"transmissionFactor", spec.transmission}};
        extensions["KHR_materials_ior"] = {{"ior", spec.ior}};
    }
    if (spec.thickness > 0.0f) extensions["KHR_materials_volume"] = {{"thicknessFactor", spec.thickness}};
    if (spec.specular < 1.0f) extensions["KHR_materials_specular"] = {{"specularFactor", spec.specular}};
    return extensions;
}

void writeUint32(std::ofstream& out, size_t value) {
    const auto v = static_cast<uint32_t>(value);
    const std::array<char, 4> bytes = {static_cast<char>(v & 0xff), static_cast<char>((v >> 8) & 0xff),
                                       static_cast<char>((v >> 16) & 0xff), static_cast<char>((v >> 24) & 0xff)};
    out.write(bytes.data(), 4);
}

void writeChunk(std::ofstream& out, size_t type, const std::vector<uint8_t>& bytes) {
    writeUint32(out, bytes.size());
    writeUint32(out, type);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

GltfWriter::GltfWriter(std::string sceneName) {
    document_ = {{"asset", {{"version", "2.0"}, {"generator", "raylab-make-assets"}}},
                 {"scene", 0},
                 {"scenes", json::array({{{"name", std::move(sceneName)}, {"nodes", json::array()}}})},
                 {"samplers", json::array({{{"magFilter", 9729}, {"minFilter", 9987}}})}};
}

uint32_t GltfWriter::addBufferView(const void* data, size_t sizeBytes, int target) {
    padTo4(binary_, 0);
    json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", sizeBytes}};
    if (target != kNoTarget) view["target"] = target;
    const size_t offset = binary_.size();
    binary_.resize(offset + sizeBytes);
    std::memcpy(binary_.data() + offset, data, sizeBytes);
    document_["bufferViews"].push_back(view);
    return static_cast<uint32_t>(document_["bufferViews"].size() - 1);
}

uint32_t GltfWriter::addAccessor(uint32_t view, int componentType, const char* type, size_t count) {
    document_["accessors"].push_back(
        {{"bufferView", view}, {"componentType", componentType}, {"type", type}, {"count", count}});
    return static_cast<uint32_t>(document_["accessors"].size() - 1);
}

uint32_t GltfWriter::addVec3Accessor(const std::vector<glm::vec3>& values, bool withBounds) {
    const uint32_t view = addBufferView(values.data(), values.size() * sizeof(glm::vec3), kArrayBuffer);
    const uint32_t accessor = addAccessor(view, kFloat, "VEC3", values.size());
    if (withBounds) {
        glm::vec3 low = values.front();
        glm::vec3 high = values.front();
        for (const glm::vec3& v : values) {
            low = glm::min(low, v);
            high = glm::max(high, v);
        }
        document_["accessors"][accessor]["min"] = toJson(low);
        document_["accessors"][accessor]["max"] = toJson(high);
    }
    return accessor;
}

void GltfWriter::useExtension(const std::string& name) {
    json& used = document_["extensionsUsed"];
    for (const json& known : used) {
        if (known == name) return;
    }
    used.push_back(name);
}

uint32_t GltfWriter::addTexture(const std::string& name, const std::vector<uint8_t>& png) {
    const uint32_t view = addBufferView(png.data(), png.size(), kNoTarget);
    document_["images"].push_back({{"name", name}, {"bufferView", view}, {"mimeType", "image/png"}});
    document_["textures"].push_back({{"source", document_["images"].size() - 1}, {"sampler", 0}});
    return static_cast<uint32_t>(document_["textures"].size() - 1);
}

uint32_t GltfWriter::addMaterial(const MaterialSpec& spec) {
    json material = {{"name", spec.name}, {"pbrMetallicRoughness", pbrToJson(spec)}};
    if (spec.normalTexture) material["normalTexture"] = {{"index", *spec.normalTexture}, {"scale", spec.normalScale}};
    const float strength = glm::max(spec.emission.x, glm::max(spec.emission.y, spec.emission.z));
    if (strength > 0.0f) material["emissiveFactor"] = toJson(spec.emission / glm::max(strength, 1.0f));
    if (spec.alphaCutoff) {
        material["alphaMode"] = "MASK";
        material["alphaCutoff"] = *spec.alphaCutoff;
    }
    if (spec.doubleSided) material["doubleSided"] = true;
    const json extensions = extensionsToJson(spec);
    if (!extensions.empty()) material["extensions"] = extensions;
    for (const auto& [name, value] : extensions.items()) useExtension(name);
    document_["materials"].push_back(material);
    return static_cast<uint32_t>(document_["materials"].size() - 1);
}

uint32_t GltfWriter::addMesh(const std::string& name, const Geometry& geometry, uint32_t material) {
    const uint32_t positions = addVec3Accessor(geometry.positions, true);
    const uint32_t normals = addVec3Accessor(geometry.normals, false);
    const uint32_t uvView = addBufferView(geometry.uvs.data(), geometry.uvs.size() * sizeof(glm::vec2), kArrayBuffer);
    const uint32_t uvs = addAccessor(uvView, kFloat, "VEC2", geometry.uvs.size());
    const uint32_t indexView =
        addBufferView(geometry.triangles.data(), geometry.triangles.size() * sizeof(glm::uvec3), kElementArrayBuffer);
    const uint32_t indices = addAccessor(indexView, kUint32, "SCALAR", 3 * geometry.triangles.size());
    const json primitive = {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
                            {"indices", indices},
                            {"material", material}};
    document_["meshes"].push_back({{"name", name}, {"primitives", json::array({primitive})}});
    return static_cast<uint32_t>(document_["meshes"].size() - 1);
}

void GltfWriter::addInstance(const std::string& name, uint32_t mesh, const glm::mat4& objectToWorld) {
    json node = {{"name", name}, {"mesh", mesh}};
    if (objectToWorld != glm::mat4(1.0f)) node["matrix"] = matrixToJson(objectToWorld);
    document_["nodes"].push_back(node);
    document_["scenes"][0]["nodes"].push_back(document_["nodes"].size() - 1);
}

void GltfWriter::addCamera(const std::string& name, glm::vec3 eye, glm::vec3 target, float fovYRadians, float aspect) {
    const float distance = glm::distance(eye, target);
    document_["cameras"].push_back(
        {{"name", name},
         {"type", "perspective"},
         {"perspective",
          {{"yfov", fovYRadians}, {"aspectRatio", aspect}, {"znear", 0.01f * distance}, {"zfar", 100.0f * distance}}}});
    const glm::mat4 cameraToWorld = glm::inverse(glm::lookAt(eye, target, glm::vec3(0.0f, 1.0f, 0.0f)));
    document_["nodes"].push_back(
        {{"name", name}, {"camera", document_["cameras"].size() - 1}, {"matrix", matrixToJson(cameraToWorld)}});
    document_["scenes"][0]["nodes"].push_back(document_["nodes"].size() - 1);
}

void GltfWriter::setExtras(nlohmann::json extras) { document_["scenes"][0]["extras"] = std::move(extras); }

void GltfWriter::write(const std::filesystem::path& path) const {
    std::vector<uint8_t> binary = binary_;
    padTo4(binary, 0);
    json document = document_;
    document["buffers"] = json::array({{{"byteLength", binary.size()}}});
    const std::string text = document.dump();
    std::vector<uint8_t> header(text.begin(), text.end());
    padTo4(header, ' ');

    const std::filesystem::path temporary = path.string() + ".part";
    std::ofstream out(temporary, std::ios::binary);
    out.write("glTF", 4);
    writeUint32(out, 2);
    writeUint32(out, 12 + 8 + header.size() + 8 + binary.size());
    writeChunk(out, 0x4E4F534A, header);
    writeChunk(out, 0x004E4942, binary);
    out.close();
    if (!out) throw std::runtime_error("cannot write " + temporary.string() + ": is the folder there, the disk full?");
    std::filesystem::rename(temporary, path);
}

}  // namespace raylab::assets
