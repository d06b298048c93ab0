#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/scene.h"

namespace raylab {

/// An encoded image: a file, or bytes or a data URI that their owner keeps until resolveTextures has run.
struct ImageSource {
    std::string name;  ///< unique: tells sources apart, and is what warnings call it
    std::filesystem::path file;
    std::span<const std::byte> bytes;
    std::string_view dataUri;
    std::string label = {};  ///< the author's name for it; empty: `name` serves

    bool empty() const { return name.empty(); }
};

ImageSource imageFile(const std::filesystem::path& file);

enum class TextureRole {
    color,  ///< sRGB
    data,   ///< linear
    bump,   ///< linear; a grey image is a height map, which cannot serve as a normal map and is left out
};

struct TextureRequest {
    ImageSource image;  ///< empty: white, for an alpha map alone
    ImageSource alpha;  ///< not empty: its alpha, or its red channel where it has none, becomes the alpha
    TextureRole role = TextureRole::color;
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    std::string usedBy;  ///< material, for warnings
};

/// The textures that materials ask for. While a scene is being imported, the texture indices of its materials count
/// requests.
class TextureRequests {
public:
    /// Index to store in the material; equal requests share one.
    int32_t add(TextureRequest request);
    const std::vector<TextureRequest>& all() const { return requests_; }

private:
    std::vector<TextureRequest> requests_;
};

/// Decodes every image that a material refers to once, in parallel, fills scene.textures and turns the materials'
/// request indices into texture indices. An image that is missing or damaged leaves the factor alone, with a warning
/// that names image and material.
void resolveTextures(const TextureRequests& requests, Scene& scene);

}  // namespace raylab
