#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/exr_names.h"
#include "engine/image/formats.h"

namespace raylab {
namespace fs = std::filesystem;
namespace {

class MemoryInput : public Imf::IStream {
public:
    MemoryInput(std::span<const std::byte> bytes, const char* name) : Imf::IStream(name), bytes_(bytes) {}

    bool read(char target[], int count) override {
        const auto wanted = static_cast<size_t>(count);
        if (position_ > bytes_.size() || wanted > bytes_.size() - position_)
            throw std::runtime_error("it is cut short");
        std::memcpy(target, bytes_.data() + position_, wanted);
        position_ += wanted;
        return position_ < bytes_.size();
    }
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = position; }

private:
    std::span<const std::byte> bytes_;
    size_t position_ = 0;
};

/// The channels of one layer: `components` are the last parts of their names, `channels` the whole names.
struct ChannelGroup {
    std::string layer;
    std::vector<std::string> components;
    std::vector<std::string> channels;
};

/// A layer as read, with the meaning of its channels.
struct NamedLayer {
    Layer layer;
    std::vector<std::string> components;
};

/// Colours in their usual order, alpha last, other components as the file has them (by name).
size_t rankOf(const std::string& component) {
    constexpr std::string_view kOrder = "RGBXYZUV";
    if (component == "A") return kOrder.size() + 1;
    return component.size() == 1 ? std::min(kOrder.find(component[0]), kOrder.size()) : kOrder.size();
}

ChannelGroup& groupNamed(std::vector<ChannelGroup>& groups, const std::string& layer) {
    const auto found = std::ranges::find(groups, layer, &ChannelGroup::layer);
    return found != groups.end() ? *found : groups.emplace_back(ChannelGroup{layer, {}, {}});
}

std::vector<ChannelGroup> groupChannels(const Imf::ChannelList& channels, const fs::path& path) {
    std::vector<std::string> names;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw Error(path.string() + ": its channel '" + channel.name() +
                        "' is subsampled; save the image as plain RGB");
        names.emplace_back(channel.name());
    }
    const auto component = [](const std::string& name) { return name.substr(name.rfind('.') + 1); };
    std::ranges::stable_sort(names, {}, [&](const std::string& name) { return rankOf(component(name)); });

    std::vector<ChannelGroup> groups;
    for (const std::string& name : names) {
        const size_t dot = name.rfind('.');
        const bool isOwnLayer = dot == std::string::npos && !isMainExrChannel(name);
        ChannelGroup& group =
            groupNamed(groups, isOwnLayer ? name : name.substr(0, dot == std::string::npos ? 0 : dot));
        group.components.push_back(component(name));
        group.channels.push_back(name);
    }
    std::ranges::stable_sort(groups, {}, &ChannelGroup::layer);
    return groups;
}

void readPart(Imf::MultiPartInputFile& file, int index, std::vector<NamedLayer>& layers, const fs::path& path) {
    const Imf::Header& header = file.header(index);
    if (header.hasType() && Imf::isDeepData(header.type()))
        throw Error(path.string() + ": holds deep data; flatten the image first");
    const Imath::Box2i window = header.dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    formats::requireSaneSize(width, height, path);

    const std::vector<ChannelGroup> groups = groupChannels(header.channels(), path);
    const size_t firstLayer = layers.size();
    Imf::FrameBuffer frame;
    for (const ChannelGroup& group : groups) {
        const int channelCount = static_cast<int>(group.channels.size());
        Bitmap bitmap(static_cast<int>(width), static_cast<int>(height), channelCount);
        layers.push_back({{group.layer, std::move(bitmap)}, group.components});
        float* pixels = layers.back().layer.bitmap.pixels.data();
        const size_t pixelBytes = sizeof(float) * group.channels.size();
        for (size_t c = 0; c < group.channels.size(); ++c)
            frame.insert(group.channels[c], Imf::Slice::Make(Imf::FLOAT, pixels + c, window, pixelBytes,
                                                             pixelBytes * static_cast<size_t>(width)));
    }
    Imf::InputPart part(file, index);
    part.setFrameBuffer(frame);
    part.readPixels(window.min.y, window.max.y);

    for (size_t i = firstLayer; i < layers.size(); ++i) {
        std::string& name = layers[i].layer.name;
        const auto sameName = [&](const NamedLayer& other) { return other.layer.name == name; };
        const auto end = layers.begin() + static_cast<std::ptrdiff_t>(firstLayer);
        if (std::none_of(layers.begin(), end, sameName)) continue;
        if (!name.empty()) name.insert(0, 1, '.');
        name.insert(0, header.name());
    }
}

Metadata metadataOf(const Imf::Header& header) {
    Metadata metadata;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const std::string_view name = attribute.name();
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        if (text && name.starts_with(kExrMetadataPrefix))
            metadata.emplace_back(name.substr(kExrMetadataPrefix.size()), text->value());
    }
    return metadata;
}

std::vector<NamedLayer> readLayers(std::span<const std::byte> bytes, const fs::path& path, Metadata* metadata) {
    try {
        MemoryInput stream(bytes, path.filename().c_str());
        Imf::MultiPartInputFile file(stream);
        std::vector<NamedLayer> layers;
        for (int part = 0; part < file.parts(); ++part) readPart(file, part, layers, path);
        if (metadata) *metadata = metadataOf(file.header(0));
        return layers;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(path.string() + ": is damaged, or no EXR image (" + error.what() + "); export the image again");
    }
}

std::string quotedNames(const std::vector<NamedLayer>& layers) {
    std::string names;
    for (const NamedLayer& layer : layers) names += (names.empty() ? "'" : ", '") + layer.layer.name + "'";
    return names;
}

}  // namespace

std::vector<Layer> readExrLayers(const fs::path& path, Metadata* metadata) {
    std::vector<Layer> result;
    for (NamedLayer& layer : readLayers(readFile(path), path, metadata)) result.push_back(std::move(layer.layer));
    return result;
}

Bitmap formats::decodeExr(std::span<const std::byte> bytes, Alpha alpha, const fs::path& path) {
    using Names = std::vector<std::string>;
    std::vector<NamedLayer> layers = readLayers(bytes, path, nullptr);
    const auto main = std::ranges::find(layers, "", [](const NamedLayer& layer) { return layer.layer.name; });
    const Names components = main == layers.end() ? Names{} : main->components;
    const bool isColor = components == Names{"R", "G", "B"} || components == Names{"R", "G", "B", "A"};
    const bool isGrey = components == Names{"Y"} || components == Names{"Y", "A"};
    if (!isColor && !isGrey)
        throw Error(path.string() + ": has no main R, G, B or Y channels, only the layers " + quotedNames(layers) +
                    "; save the one to read as the main layer");

    const bool keepAlpha = alpha == Alpha::keep && components.back() == "A";
    const Bitmap& source = main->layer.bitmap;
    Bitmap bitmap(source.width, source.height, keepAlpha ? 4 : 3);
    const float* in = source.pixels.data();
    float* out = bitmap.pixels.data();
    for (size_t i = 0; i < source.pixelCount(); ++i, in += source.channels) {
        for (int c = 0; c < 3; ++c) *out++ = in[isGrey ? 0 : c];
        if (keepAlpha) *out++ = in[source.channels - 1];
    }
    return bitmap;
}

}  // namespace raylab
