#include "engine/scene/import_texture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/image8.h"
#include "engine/scene/data_uri.h"
#include "engine/scene/texture_slots.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

struct DecodedImage {
    std::optional<Image8> image;
    std::string whyNot;
};

using DecodedImages = std::map<std::string, DecodedImage>;

DecodedImage decode(const ImageSource& source) {
    DecodedImage decoded;
    try {
        std::vector<std::byte> contents;
        if (!source.file.empty()) contents = readFile(source.file);
        if (!source.dataUri.empty()) contents = decodeDataUri(source.dataUri, source.name);
        decoded.image = decodeImage8(contents.empty() ? source.bytes : contents, decoded.whyNot);
    } catch (const Error& problem) {
        decoded.whyNot = problem.what();
    } catch (const std::bad_alloc&) {
        decoded.whyNot = "not enough memory to decode it";
    }
    return decoded;
}

/// Requests that some material still refers to (the material may have dropped its texture, the scene the material), in
/// the order in which the materials name them: that of the textures, so that saving and reading again keeps it.
std::vector<size_t> usedRequests(size_t requestCount, std::vector<Material>& materials) {
    std::vector<bool> seen(requestCount, false);
    std::vector<size_t> used;
    for (Material& material : materials)
        for (const int32_t* slot : textureSlots(material)) {
            if (*slot == kNoTexture || seen[static_cast<size_t>(*slot)]) continue;
            seen[static_cast<size_t>(*slot)] = true;
            used.push_back(static_cast<size_t>(*slot));
        }
    return used;
}

DecodedImages decodeAll(const std::vector<TextureRequest>& requests, const std::vector<size_t>& used) {
    std::map<std::string, const ImageSource*> sources;
    for (const size_t r : used)
        for (const ImageSource* source : {&requests[r].image, &requests[r].alpha})
            if (!source->empty()) sources.emplace(source->name, source);
    const std::vector<std::pair<std::string, const ImageSource*>> list(sources.begin(), sources.end());
    std::vector<DecodedImage> results(list.size());
    tbb::parallel_for(size_t{0}, list.size(), [&](size_t i) { results[i] = decode(*list[i].second); });
    DecodedImages decoded;
    for (size_t i = 0; i < list.size(); ++i) decoded.emplace(list[i].first, std::move(results[i]));
    return decoded;
}

bool isGrey(const Image8& image) {
    return std::all_of(image.texels.begin(), image.texels.end(), [](uint32_t texel) {
        const uint32_t red = texel & 0xFF;
        return red == ((texel >> 8) & 0xFF) && red == ((texel >> 16) & 0xFF);
    });
}

/// Alpha of `alpha` into `color`, the nearest texel where the sizes differ.
void mergeAlpha(Image8& color, const Image8& alpha) {
    const uint32_t shift = alpha.hasAlpha ? 24 : 0;
    for (uint32_t y = 0; y < color.height; ++y) {
        const uint64_t row = static_cast<uint64_t>(y) * alpha.height / color.height * alpha.width;
        for (uint32_t x = 0; x < color.width; ++x) {
            const uint32_t value =
                alpha.texels[row + static_cast<uint64_t>(x) * alpha.width / color.width] >> shift & 0xFF;
            uint32_t& texel = color.texels[static_cast<size_t>(y) * color.width + x];
            texel = (texel & 0x00FFFFFFu) | (value << 24);
        }
    }
}

Image8 whiteLike(const Image8& image) {
    Image8 white = image;
    std::fill(white.texels.begin(), white.texels.end(), 0xFFFFFFFFu);
    return white;
}

/// The decoded image, or nothing and a warning.
const Image8* find(const DecodedImages& decoded, const ImageSource& source, const std::string& usedBy,
                   std::vector<std::string>& warnings) {
    if (source.empty()) return nullptr;
    const DecodedImage& entry = decoded.at(source.name);
    if (entry.image) return &*entry.image;
    warnings.push_back("texture " + source.name + " of material \"" + usedBy + "\" was left out: " + entry.whyNot);
    return nullptr;
}

/// The pixels that a request asks for, or nothing and a warning.
std::optional<Image8> pixelsOf(const TextureRequest& request, const DecodedImages& decoded,
                               std::vector<std::string>& warnings) {
    const Image8* image = find(decoded, request.image, request.usedBy, warnings);
    const Image8* alpha = find(decoded, request.alpha, request.usedBy, warnings);
    if (request.role == TextureRole::bump && image && isGrey(*image)) {
        warnings.push_back("texture " + request.image.name + " of material \"" + request.usedBy +
                           "\" is a grey height map and was left out: give a normal map instead");
        return std::nullopt;
    }
    if (!image && !alpha) return std::nullopt;
    Image8 pixels = image ? *image : whiteLike(*alpha);
    if (alpha) mergeAlpha(pixels, *alpha);
    return pixels;
}

}  // namespace

ImageSource imageFile(const fs::path& file) {
    return {.name = file.lexically_normal().string(), .file = file, .bytes = {}, .dataUri = {}};
}

int32_t TextureRequests::add(TextureRequest request) {
    const auto same = [&request](const TextureRequest& other) {
        return other.image.name == request.image.name && other.alpha.name == request.alpha.name &&
               other.role == request.role && other.wrapU == request.wrapU && other.wrapV == request.wrapV;
    };
    const auto found = std::find_if(requests_.begin(), requests_.end(), same);
    const auto index = static_cast<int32_t>(found - requests_.begin());
    if (found == requests_.end()) requests_.push_back(std::move(request));
    return index;
}

void resolveTextures(const TextureRequests& requests, Scene& scene) {
    const std::vector<size_t> used = usedRequests(requests.all().size(), scene.materials);
    const DecodedImages decoded = decodeAll(requests.all(), used);
    std::vector<int32_t> textureOf(requests.all().size(), kNoTexture);
    for (const size_t r : used) {
        const TextureRequest& request = requests.all()[r];
        std::optional<Image8> pixels = pixelsOf(request, decoded, scene.warnings);
        if (!pixels) continue;
        textureOf[r] = static_cast<int32_t>(scene.textures.size());
        const ImageSource& source = request.image.empty() ? request.alpha : request.image;
        scene.textures.push_back({.name = source.label.empty() ? source.name : source.label,
                                  .width = pixels->width,
                                  .height = pixels->height,
                                  .texels = std::move(pixels->texels),
                                  .srgb = request.role == TextureRole::color,
                                  .wrapU = request.wrapU,
                                  .wrapV = request.wrapV});
    }
    for (Material& material : scene.materials) {
        for (int32_t* slot : textureSlots(material))
            if (*slot != kNoTexture) *slot = textureOf[static_cast<size_t>(*slot)];
        if (material.normalTexture == kNoTexture) material.normalScale = 1.0f;
        if (material.lobeTextures.clearcoatNormal == kNoTexture) material.lobeTextures.clearcoatNormalScale = 1.0f;
    }
}

}  // namespace raylab
