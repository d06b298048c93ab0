#pragma once

#include <cstdint>
#include <optional>

#include "engine/scene/gltf_document.h"

namespace raylab {

/// glTF 2.0, section 3.6.2.2; the values are those of the file.
enum class ComponentType : uint32_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// One accessor, its byte range proved to lie inside its buffer.
struct Accessor {
    size_t count = 0;
    size_t components = 1;
    ComponentType type = ComponentType::f32;
    bool normalized = false;
    bool sparse = false;
    std::span<const std::byte> bytes;  ///< from the first element to the end of the view; empty: all zeros
    size_t stride = 0;                 ///< bytes from one element to the next

    size_t elementSize() const;
};

size_t componentSize(ComponentType type);

/// Bytes of bufferViews[index]. Throws Error where it reaches outside its buffer.
std::span<const std::byte> viewBytes(const GltfDocument& document, size_t index);

/// Throws Error (naming the accessor) for an unknown type, a bad count or a range outside the view.
Accessor accessorAt(const GltfDocument& document, size_t index);

/// count * components values, normalised integers scaled as section 3.6.2.2 says, sparse values put in place.
std::vector<float> readFloats(const GltfDocument& document, size_t index);

/// The same for indices (unsigned integers). Throws Error for another type.
std::vector<uint32_t> readIndices(const GltfDocument& document, size_t index);

}  // namespace raylab
