#include "engine/image/image8.h"

#include <algorithm>

#include "engine/image/formats.h"
#include "engine/image/srgb.h"

namespace raylab {

std::vector<std::byte> encodePng8(std::span<const uint32_t> texels, uint32_t width, uint32_t height) {
    const bool opaque = std::all_of(texels.begin(), texels.end(), [](uint32_t texel) { return texel >> 24 == 255; });
    const uint32_t channels = opaque ? 3 : 4;
    std::vector<uint8_t> samples;
    samples.reserve(texels.size() * channels);
    for (const uint32_t texel : texels)
        for (uint32_t c = 0; c < channels; ++c) samples.push_back(static_cast<uint8_t>(texel >> 8 * c & 0xFF));
    return formats::encodePng8(samples, static_cast<int>(width), static_cast<int>(height), static_cast<int>(channels));
}

Image8 encodeSrgb8(const Bitmap& displayReferred) {
    Image8 image;
    image.width = static_cast<uint32_t>(displayReferred.width);
    image.height = static_cast<uint32_t>(displayReferred.height);
    image.texels.resize(displayReferred.pixelCount());
    const size_t channels = static_cast<size_t>(displayReferred.channels), last = channels - 1;
    for (size_t i = 0; i < image.texels.size(); ++i) {
        const float* p = displayReferred.pixels.data() + channels * i;
        uint32_t texel = 0xff000000u;
        for (size_t c = 0; c < 3; ++c) texel |= uint32_t{linearToSrgb8(p[std::min(c, last)])} << 8 * c;
        image.texels[i] = texel;
    }
    return image;
}

}  // namespace raylab
