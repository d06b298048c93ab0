// The one place that compiles stb_image_write.
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

#include "engine/core/error.h"
#include "engine/image/formats.h"

namespace raylab {

std::vector<std::byte> formats::encodePng8(std::span<const uint8_t> samples, int width, int height, int channels) {
    std::vector<std::byte> file;
    const auto append = [](void* user, void* data, int size) {
        const auto* bytes = static_cast<const std::byte*>(data);
        static_cast<std::vector<std::byte>*>(user)->assign(bytes, bytes + size);
    };
    if (!stbi_write_png_to_func(append, &file, width, height, channels, samples.data(), width * channels))
        throw Error("out of memory while compressing a PNG image of " + std::to_string(width) + " x " +
                        std::to_string(height) + " pixels",
                    ExitCode::internalError);
    return file;
}

}  // namespace raylab
