#include "engine/scene/gltf_accessor.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

namespace raylab {
namespace {

/// An accessor without a buffer view is all zeros, so a short file could ask for any amount of memory.
constexpr size_t kLargestZeroAccessor = size_t{1} << 24;

size_t componentCount(const JsonView& accessor) {
    constexpr std::array<std::pair<const char*, size_t>, 7> kTypes = {
        {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
    const std::string type = accessor.text("type", "");
    for (const auto& [name, components] : kTypes)
        if (type == name) return components;
    accessor.fail("has the type \"" + type + "\"");
}

ComponentType componentTypeOf(const JsonView& accessor) {
    const size_t type = accessor.count("componentType", 0);
    if (type < 5120 || type > 5126 || type == 5124)
        accessor.fail("has the component type " + std::to_string(type) + ", which glTF does not know");
    return static_cast<ComponentType>(type);
}

template <class T>
float decode(const std::byte* bytes, bool normalized) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    if constexpr (std::is_floating_point_v<T>) return value;
    const float number = static_cast<float>(value);
    if (!normalized) return number;
    return std::max(number / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

float decodeFloat(const std::byte* bytes, ComponentType type, bool normalized) {
    switch (type) {
        case ComponentType::i8:
            return decode<int8_t>(bytes, normalized);
        case ComponentType::u8:
            return decode<uint8_t>(bytes, normalized);
        case ComponentType::i16:
            return decode<int16_t>(bytes, normalized);
        case ComponentType::u16:
            return decode<uint16_t>(bytes, normalized);
        case ComponentType::u32:
            return decode<uint32_t>(bytes, normalized);
        case ComponentType::f32:
            return decode<float>(bytes, false);
    }
    return 0.0f;
}

uint32_t decodeIndex(const std::byte* bytes, ComponentType type) {
    uint32_t value = 0;
    std::memcpy(&value, bytes, componentSize(type));  // little-endian on both sides
    return value;
}

/// Tightly packed elements of one part of a sparse description, range-checked.
struct SparsePart {
    const std::byte* bytes;
    ComponentType type;
};

SparsePart sparsePart(const GltfDocument& document, const JsonView& part, ComponentType type, size_t byteCount) {
    const std::optional<size_t> view = part.index("bufferView", document.root().array("bufferViews").size());
    if (!view) part.fail("has no bufferView");
    const std::span<const std::byte> bytes = viewBytes(document, *view);
    const size_t offset = part.count("byteOffset", 0);
    if (offset > bytes.size() || byteCount > bytes.size() - offset) part.fail("reaches outside its bufferView");
    return {bytes.data() + offset, type};
}

/// Calls place(element, bytes) for every replaced element (section 3.6.2.3).
template <class Place>
void applySparse(const GltfDocument& document, const JsonView& accessor, const Accessor& info, const Place& place) {
    const JsonView sparse = accessor.object("sparse");
    const size_t count = sparse.count("count", 0);
    if (count > info.count) sparse.fail("replaces more elements than there are");
    const ComponentType indexType = componentTypeOf(sparse.object("indices"));
    const SparsePart indices =
        sparsePart(document, sparse.object("indices"), indexType, count * componentSize(indexType));
    const SparsePart values = sparsePart(document, sparse.object("values"), info.type, count * info.elementSize());
    for (size_t i = 0; i < count; ++i) {
        const uint32_t element = decodeIndex(indices.bytes + i * componentSize(indexType), indexType);
        if (element >= info.count)
            sparse.fail("replaces element " + std::to_string(element) + ", which does not exist");
        place(element, values.bytes + i * info.elementSize());
    }
}

JsonView accessorJson(const GltfDocument& document, size_t index) {
    return document.root().array("accessors").element(index);
}

}  // namespace

size_t componentSize(ComponentType type) {
    switch (type) {
        case ComponentType::i8:
        case ComponentType::u8:
            return 1;
        case ComponentType::i16:
        case ComponentType::u16:
            return 2;
        case ComponentType::u32:
        case ComponentType::f32:
            return 4;
    }
    return 4;
}

size_t Accessor::elementSize() const { return components * componentSize(type); }

std::span<const std::byte> viewBytes(const GltfDocument& document, size_t index) {
    const JsonView view = document.root().array("bufferViews").element(index);
    const std::optional<size_t> buffer = view.index("buffer", document.buffers.size());
    if (!buffer) view.fail("names no buffer");
    const std::span<const std::byte> bytes = document.buffers[*buffer];
    const size_t offset = view.count("byteOffset", 0);
    const size_t length = view.count("byteLength", 0);
    if (offset > bytes.size() || length > bytes.size() - offset)
        view.fail("reaches to byte " + std::to_string(offset + length) + " of a buffer of " +
                  std::to_string(bytes.size()));
    return bytes.subspan(offset, length);
}

Accessor accessorAt(const GltfDocument& document, size_t index) {
    const JsonView json = accessorJson(document, index);
    Accessor info;
    info.count = json.count("count", 0);
    info.components = componentCount(json);
    info.type = componentTypeOf(json);
    info.normalized = json.flag("normalized", false);
    info.sparse = json.has("sparse");
    info.stride = info.elementSize();
    const JsonView views = document.root().array("bufferViews");
    const std::optional<size_t> view = json.index("bufferView", views.size());
    if (!view) {
        if (info.count > kLargestZeroAccessor) json.fail("asks for too many elements without a bufferView");
        return info;
    }
    info.stride = views.element(*view).count("byteStride", info.stride);
    const std::span<const std::byte> bytes = viewBytes(document, *view);
    const size_t offset = json.count("byteOffset", 0);
    if (info.stride < info.elementSize() || info.stride > 65535)
        json.fail("is in a bufferView with byteStride " + std::to_string(info.stride) + ", which does not fit it");
    const bool fits = offset <= bytes.size() && info.count <= bytes.size() &&
                      (info.count == 0 || (info.count - 1) * info.stride + info.elementSize() <= bytes.size() - offset);
    if (!fits)
        json.fail("needs " + std::to_string(info.count) + " elements of " + std::to_string(info.elementSize()) +
                  " bytes, but its bufferView ends after " + std::to_string(bytes.size()) + " bytes");
    info.bytes = bytes.subspan(offset);
    return info;
}

std::vector<float> readFloats(const GltfDocument& document, size_t index) {
    const Accessor info = accessorAt(document, index);
    std::vector<float> values(info.count * info.components);
    const auto place = [&](size_t element, const std::byte* bytes) {
        for (size_t c = 0; c < info.components; ++c)
            values[element * info.components + c] =
                decodeFloat(bytes + c * componentSize(info.type), info.type, info.normalized);
    };
    if (!info.bytes.empty())
        for (size_t i = 0; i < info.count; ++i) place(i, info.bytes.data() + i * info.stride);
    if (info.sparse) applySparse(document, accessorJson(document, index), info, place);
    return values;
}

std::vector<uint32_t> readIndices(const GltfDocument& document, size_t index) {
    const Accessor info = accessorAt(document, index);
    const JsonView json = accessorJson(document, index);
    const bool isUnsigned =
        info.type == ComponentType::u8 || info.type == ComponentType::u16 || info.type == ComponentType::u32;
    if (!isUnsigned || info.components != 1) json.fail("is used for indices, but holds no unsigned integers");
    std::vector<uint32_t> values(info.count);
    const auto place = [&](size_t element, const std::byte* bytes) { values[element] = decodeIndex(bytes, info.type); };
    if (!info.bytes.empty())
        for (size_t i = 0; i < info.count; ++i) place(i, info.bytes.data() + i * info.stride);
    if (info.sparse) applySparse(document, json, info, place);
    return values;
}

}  // namespace raylab
