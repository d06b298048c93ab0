#include "engine/scene/gltf_geometry.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>

#include "engine/scene/gltf_accessor.h"

namespace raylab {
namespace {

/// Primitive modes of glTF (section 5.24.4) from which triangles come.
constexpr size_t kTriangles = 4;
constexpr size_t kTriangleFan = 6;

struct LeftOut {
    size_t pointsAndLines = 0;
    size_t badTriangles = 0;
    size_t mismatched = 0;
    size_t coloured = 0;
    size_t morphed = 0;
};

/// Builds the plain document; accessors that two primitives share stay shared.
class PlainBuilder {
public:
    PlainBuilder(const GltfDocument& document, LeftOut& leftOut) : document_(document), leftOut_(leftOut) {
        plain_["asset"]["version"] = "2.0";
        plain_["scene"] = 0;
        plain_["accessors"] = plain_["bufferViews"] = plain_["nodes"] = plain_["meshes"] = nlohmann::json::array();
        plain_["scenes"] = nlohmann::json::array({{{"nodes", nlohmann::json::array()}}});
    }

    /// With texture coordinates of that set. False where the primitive yields no triangles.
    bool add(const JsonView& primitive, size_t uvSet);
    void finish(PlainGltf& result);

private:
    nlohmann::json attributesOf(const JsonView& primitive, size_t uvSet, size_t vertexCount);
    /// The accessor of an attribute that matches the positions; others are counted.
    std::optional<size_t> matching(const JsonView& primitive, const std::string& name, size_t components,
                                   size_t vertexCount);
    /// Nothing where every triangle names a vertex that does not exist.
    std::optional<size_t> indicesOf(size_t accessor, size_t mode, size_t vertexCount);
    size_t floatAccessor(size_t accessor);
    /// Of texture coordinates, as (u, 0, v).
    size_t uvAccessor(size_t accessor);
    size_t passThrough(size_t accessor, const Accessor& info);
    size_t unroll(const void* data, size_t byteCount, size_t count, ComponentType type, const char* shape);

    const GltfDocument& document_;
    LeftOut& leftOut_;
    nlohmann::json plain_;
    std::vector<std::byte> unrolled_;
    std::unordered_map<size_t, size_t> floatAccessors_, uvAccessors_;
};

const char* shapeName(size_t components) {
    constexpr const char* kNames[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    return kNames[std::min<size_t>(components, 4) - 1];
}

size_t PlainBuilder::unroll(const void* data, size_t byteCount, size_t count, ComponentType type, const char* shape) {
    const size_t offset = unrolled_.size();
    const std::byte* bytes = static_cast<const std::byte*>(data);
    unrolled_.insert(unrolled_.end(), bytes, bytes + byteCount);
    plain_["bufferViews"].push_back(
        {{"buffer", document_.buffers.size()}, {"byteOffset", offset}, {"byteLength", byteCount}});
    plain_["accessors"].push_back({{"bufferView", plain_["bufferViews"].size() - 1},
                                   {"componentType", static_cast<uint32_t>(type)},
                                   {"count", count},
                                   {"type", shape}});
    return plain_["accessors"].size() - 1;
}

size_t PlainBuilder::passThrough(size_t accessor, const Accessor& info) {
    const JsonView source = document_.root().array("accessors").element(accessor);
    const nlohmann::json& view = document_.json["bufferViews"][source.count("bufferView", 0)];
    nlohmann::json copy = {{"buffer", view["buffer"]}, {"byteLength", view["byteLength"]}};
    for (const char* key : {"byteOffset", "byteStride"})
        if (view.contains(key)) copy[key] = view[key];
    plain_["bufferViews"].push_back(std::move(copy));
    plain_["accessors"].push_back({{"bufferView", plain_["bufferViews"].size() - 1},
                                   {"byteOffset", source.count("byteOffset", 0)},
                                   {"componentType", static_cast<uint32_t>(info.type)},
                                   {"count", info.count},
                                   {"type", shapeName(info.components)}});
    return plain_["accessors"].size() - 1;
}

bool isPlain(const Accessor& info) {
    return !info.sparse && !info.bytes.empty() && info.count * info.stride <= info.bytes.size();
}

size_t PlainBuilder::floatAccessor(size_t accessor) {
    const auto [entry, isNew] = floatAccessors_.try_emplace(accessor, 0);
    if (!isNew) return entry->second;
    const Accessor info = accessorAt(document_, accessor);
    if (isPlain(info) && info.type == ComponentType::f32) return entry->second = passThrough(accessor, info);
    const std::vector<float> values = readFloats(document_, accessor);
    return entry->second = unroll(values.data(), values.size() * sizeof(float), info.count, ComponentType::f32,
                                  shapeName(info.components));
}

size_t PlainBuilder::uvAccessor(size_t accessor) {
    const auto [entry, isNew] = uvAccessors_.try_emplace(accessor, 0);
    if (!isNew) return entry->second;
    const std::vector<float> uvs = readFloats(document_, accessor);
    std::vector<float> values;
    values.reserve(uvs.size() / 2 * 3);
    for (size_t i = 0; i + 1 < uvs.size(); i += 2) values.insert(values.end(), {uvs[i], 0.0f, uvs[i + 1]});
    return entry->second = unroll(values.data(), values.size() * sizeof(float), values.size() / 3, ComponentType::f32,
                                  shapeName(3));
}

std::optional<size_t> PlainBuilder::indicesOf(size_t accessor, size_t mode, size_t vertexCount) {
    const std::vector<uint32_t> indices = readIndices(document_, accessor);
    const size_t triangleCount = mode == kTriangles ? indices.size() / 3 : indices.size() - 2;
    size_t bad = 0;
    for (size_t t = 0; t < triangleCount; ++t) {
        const size_t second = mode == kTriangles ? 3 * t + 1 : t + 1;
        const size_t first = mode == kTriangleFan ? 0 : second - 1;
        bad += std::max({indices[first], indices[second], indices[second + 1]}) >= vertexCount;
    }
    leftOut_.badTriangles += bad;
    if (bad == triangleCount) return std::nullopt;
    const Accessor info = accessorAt(document_, accessor);
    if (isPlain(info)) return passThrough(accessor, info);
    return unroll(indices.data(), indices.size() * sizeof(uint32_t), info.count, ComponentType::u32, "SCALAR");
}

std::optional<size_t> PlainBuilder::matching(const JsonView& primitive, const std::string& name, size_t components,
                                             size_t vertexCount) {
    const size_t accessorCount = document_.root().array("accessors").size();
    const std::optional<size_t> accessor = primitive.object("attributes").index(name.c_str(), accessorCount);
    if (!accessor) return std::nullopt;
    const Accessor info = accessorAt(document_, *accessor);
    if (info.components == components && info.count == vertexCount) return accessor;
    ++leftOut_.mismatched;
    return std::nullopt;
}

nlohmann::json PlainBuilder::attributesOf(const JsonView& primitive, size_t uvSet, size_t vertexCount) {
    const size_t accessorCount = document_.root().array("accessors").size();
    nlohmann::json plain = {{"POSITION", floatAccessor(*primitive.object("attributes").index("POSITION", accessorCount))}};
    if (const auto normal = matching(primitive, "NORMAL", 3, vertexCount)) plain["NORMAL"] = floatAccessor(*normal);
    if (const auto tangent = matching(primitive, "TANGENT", 4, vertexCount)) plain["TANGENT"] = floatAccessor(*tangent);
    if (const auto uvs = matching(primitive, "TEXCOORD_" + std::to_string(uvSet), 2, vertexCount))
        plain["TEXCOORD_0"] = uvAccessor(*uvs);
    return plain;
}

bool PlainBuilder::add(const JsonView& primitive, size_t uvSet) {
    const size_t accessorCount = document_.root().array("accessors").size();
    const std::optional<size_t> position = primitive.object("attributes").index("POSITION", accessorCount);
    if (!position) return false;
    const std::optional<size_t> indices = primitive.index("indices", accessorCount);
    const size_t vertexCount = accessorAt(document_, *position).count;
    const size_t cornerCount = indices ? accessorAt(document_, *indices).count : vertexCount;
    const size_t mode = primitive.count("mode", kTriangles);
    if (mode < kTriangles) leftOut_.pointsAndLines += cornerCount / (mode == 1 ? 2 : 1);
    if (mode < kTriangles || cornerCount < 3 || vertexCount == 0) return false;

    nlohmann::json plain = {{"mode", mode}, {"attributes", attributesOf(primitive, uvSet, vertexCount)}};
    if (indices) {
        const std::optional<size_t> copied = indicesOf(*indices, mode, vertexCount);
        if (!copied) return false;
        plain["indices"] = *copied;
    }
    leftOut_.coloured += primitive.object("attributes").has("COLOR_0");
    leftOut_.morphed += primitive.array("targets").size() > 0;
    const size_t part = plain_["meshes"].size();
    plain_["meshes"].push_back({{"name", std::to_string(part)}, {"primitives", nlohmann::json::array({plain})}});
    plain_["nodes"].push_back({{"mesh", part}});
    plain_["scenes"][0]["nodes"].push_back(part);
    return true;
}

void PlainBuilder::finish(PlainGltf& result) {
    nlohmann::json& buffers = plain_["buffers"] = nlohmann::json::array();
    for (size_t b = 0; b < document_.buffers.size(); ++b)
        buffers.push_back({{"uri", "buffer" + std::to_string(b)}, {"byteLength", document_.buffers[b].size()}});
    if (!unrolled_.empty()) buffers.push_back({{"uri", "unrolled"}, {"byteLength", unrolled_.size()}});
    result.json = plain_.dump();
    result.unrolled = std::move(unrolled_);
}

void report(const LeftOut& leftOut, size_t skinCount, std::vector<std::string>& warnings) {
    const auto say = [&](size_t count, const std::string& what) {
        if (count > 0) warnings.push_back(what + ": " + std::to_string(count));
    };
    say(leftOut.pointsAndLines, "points and lines left out, only triangles are rendered");
    say(leftOut.badTriangles, "triangles left out that name vertices which do not exist");
    say(leftOut.mismatched, "vertex attributes left out that do not match their positions");
    say(leftOut.coloured, "meshes with vertex colours, which are not read");
    say(leftOut.morphed, "meshes shown without their morph targets");
    say(skinCount, "skins left out, their meshes are shown as modelled");
}

}  // namespace

PlainGltf plainGeometry(const GltfDocument& document, std::span<const PlacedNode> nodes, std::span<const size_t> uvSets,
                        std::vector<std::string>& warnings) {
    const JsonView root = document.root();
    const JsonView meshes = root.array("meshes");
    std::vector<bool> shown(meshes.size(), false);
    const JsonView allNodes = root.array("nodes");
    for (const PlacedNode& placed : nodes)
        if (const auto mesh = allNodes.element(placed.node).index("mesh", meshes.size())) shown[*mesh] = true;

    PlainGltf result;
    LeftOut leftOut;
    PlainBuilder builder(document, leftOut);
    for (size_t m = 0; m < meshes.size(); ++m) {
        if (!shown[m]) continue;
        const JsonView primitives = meshes.element(m).array("primitives");
        const std::string name = meshes.element(m).text("name", "mesh " + std::to_string(m));
        for (size_t p = 0; p < primitives.size(); ++p) {
            const auto material = primitives.element(p).index("material", uvSets.size());
            if (!builder.add(primitives.element(p), material ? uvSets[*material] : 0)) continue;
            const std::string suffix = primitives.size() > 1 ? " [" + std::to_string(p) + "]" : "";
            result.parts.push_back({m, name + suffix, material});
        }
    }
    builder.finish(result);
    report(leftOut, root.array("skins").size(), warnings);
    return result;
}

}  // namespace raylab
