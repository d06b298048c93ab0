#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <cstring>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/exr_names.h"
#include "engine/image/formats.h"

namespace raylab {
namespace fs = std::filesystem;
namespace {

/// Memory, because OpenEXR's own file stream hides a failure that comes while the file is closed.
class MemoryOutput : public Imf::OStream {
public:
    explicit MemoryOutput(const char* name) : Imf::OStream(name) {}

    void write(const char source[], int count) override {
        const size_t end = position_ + static_cast<size_t>(count);
        if (end > bytes.size()) bytes.resize(end);
        std::memcpy(bytes.data() + position_, source, static_cast<size_t>(count));
        position_ = end;
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }

    std::vector<std::byte> bytes;

private:
    size_t position_ = 0;
};

std::string channelName(const Layer& layer, int channel) {
    if (layer.bitmap.channels == 1) return layer.name.empty() ? "Y" : layer.name;
    const std::string component(1, "RGBA"[channel]);
    return layer.name.empty() ? component : layer.name + "." + component;
}

void requireWritableLayers(std::span<const Layer> layers, const fs::path& path) {
    if (layers.empty()) throw Error(path.string() + ": no layer to write", ExitCode::internalError);
    const Bitmap& first = layers.front().bitmap;
    for (size_t i = 0; i < layers.size(); ++i) {
        const Bitmap& bitmap = layers[i].bitmap;
        const std::string& name = layers[i].name;
        formats::requireWhole(bitmap, path);
        if (bitmap.width != first.width || bitmap.height != first.height)
            throw Error(path.string() + ": layer '" + name + "' is " + std::to_string(bitmap.width) + " x " +
                            std::to_string(bitmap.height) + " pixels, the first " + std::to_string(first.width) +
                            " x " + std::to_string(first.height),
                        ExitCode::internalError);
        bool isTaken = name.find('.') != std::string::npos || isMainExrChannel(name);
        for (size_t j = 0; j < i; ++j) isTaken |= layers[j].name == name;
        if (isTaken)
            throw Error(path.string() + ": layer name '" + name + "' is used twice, has a dot or means a main channel",
                        ExitCode::internalError);
    }
}

Imf::Header makeHeader(const Bitmap& size, const Metadata& metadata) {
    Imf::Header header(size.width, size.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [key, value] : metadata)
        header.insert(std::string(kExrMetadataPrefix) + key, Imf::StringAttribute(value));
    return header;
}

void encode(MemoryOutput& stream, std::span<const Layer> layers, const Metadata& metadata) {
    const int height = layers.front().bitmap.height;
    Imf::Header header = makeHeader(layers.front().bitmap, metadata);
    Imf::FrameBuffer frame;
    for (const Layer& layer : layers) {
        const size_t pixelBytes = sizeof(float) * static_cast<size_t>(layer.bitmap.channels);
        for (int c = 0; c < layer.bitmap.channels; ++c) {
            const std::string name = channelName(layer, c);
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame.insert(name, Imf::Slice::Make(Imf::FLOAT, layer.bitmap.pixels.data() + c, header.dataWindow(),
                                                pixelBytes, pixelBytes * static_cast<size_t>(layer.bitmap.width)));
        }
    }
    Imf::OutputFile file(stream, header);  // its destructor completes the table of scan line offsets
    file.setFrameBuffer(frame);
    file.writePixels(height);
}

}  // namespace

void writeExr(const fs::path& path, std::span<const Layer> layers, const Metadata& metadata) {
    requireWritableLayers(layers, path);
    MemoryOutput stream(path.filename().c_str());
    try {
        encode(stream, layers, metadata);
    } catch (const std::exception& error) {
        throw Error(path.string() + ": cannot be encoded as EXR (" + error.what() + ")", ExitCode::internalError);
    }
    writeFileAtomically(path, stream.bytes);
}

}  // namespace raylab
