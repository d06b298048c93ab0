#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/formats.h"
#include "engine/image/image_io.h"

// Radiance RGBE: three mantissas and one exponent a pixel, value = mantissa * 2^(exponent - 136) as stb_image, OpenCV
// and pbrt read it (Radiance itself adds half a step). The header is text up to an empty line, then "-Y height +X
// width".

namespace raylab {
namespace fs = std::filesystem;
namespace {

using Rgbe = std::array<uint8_t, 4>;

constexpr int kExponentBias = 136;  // 128 of the exponent and 8 bits of mantissa
constexpr int kMinRunWidth = 8;     // narrower or wider scan lines are stored flat
constexpr int kMaxRunWidth = 32767;
constexpr size_t kMaxRun = 127;                 // equal bytes in one code
constexpr size_t kMaxLiteral = 128;             // different bytes in one code
constexpr size_t kMinRun = 4;                   // a shorter run costs more than it saves
constexpr float kMaxValue = 255.0f * 0x1p119f;  // the largest mantissa and exponent

[[noreturn]] void throwDamaged(const fs::path& path, const std::string& what) {
    throw Error(path.string() + ": " + what + "; export the image again");
}

/// Bytes in order; throws Error where the file is cut short.
class Reader {
public:
    Reader(std::span<const std::byte> bytes, const fs::path& path) : bytes_(bytes), path_(path) {}

    uint8_t byte() {
        if (position_ >= bytes_.size()) throwDamaged(path_, "is cut short");
        return static_cast<uint8_t>(bytes_[position_++]);
    }
    std::string line() {
        std::string text;
        for (char c = static_cast<char>(byte()); c != '\n'; c = static_cast<char>(byte())) text.push_back(c);
        if (text.ends_with('\r')) text.pop_back();
        return text;
    }
    Rgbe pixel() { return {byte(), byte(), byte(), byte()}; }

    /// The next pixel, if there is one, without taking it.
    bool startsRunLengthLine() const {
        return position_ + 3 < bytes_.size() && bytes_[position_] == std::byte{2} &&
               bytes_[position_ + 1] == std::byte{2} && bytes_[position_ + 2] < std::byte{128};
    }

private:
    std::span<const std::byte> bytes_;
    const fs::path& path_;
    size_t position_ = 0;
};

int takeNumber(std::string_view& text, std::string_view prefix, const fs::path& path) {
    int number = 0;
    if (text.starts_with(prefix)) {
        const auto [end, error] = std::from_chars(text.data() + prefix.size(), text.data() + text.size(), number);
        text.remove_prefix(static_cast<size_t>(end - text.data()));
        if (error == std::errc()) return number;
    }
    throwDamaged(path, "its size is not given as '-Y height +X width'");
}

Bitmap readHeader(Reader& reader, const fs::path& path) {
    bool isRgbe = false;
    for (std::string line = reader.line(); !line.empty(); line = reader.line())
        isRgbe |= line == "FORMAT=32-bit_rle_rgbe";
    if (!isRgbe) throwDamaged(path, "is no RGBE image (its header lacks FORMAT=32-bit_rle_rgbe)");
    const std::string resolution = reader.line();
    std::string_view rest = resolution;
    const int height = takeNumber(rest, "-Y ", path);
    const int width = takeNumber(rest, " +X ", path);
    formats::requireSaneSize(width, height, path);
    return Bitmap(width, height, 3);
}

void readRunLengthLine(Reader& reader, std::span<Rgbe> line, const fs::path& path) {
    const Rgbe marker = reader.pixel();
    if (static_cast<size_t>(marker[2] << 8 | marker[3]) != line.size())
        throwDamaged(path, "a scan line has a wrong length");
    for (size_t channel = 0; channel < 4; ++channel) {
        for (size_t x = 0; x < line.size();) {
            const uint8_t code = reader.byte();
            const bool isRun = code > kMaxLiteral;
            const size_t count = isRun ? code - kMaxLiteral : code;
            if (count == 0 || count > line.size() - x) throwDamaged(path, "a run of pixels has a wrong length");
            for (size_t i = 0, value = isRun ? reader.byte() : 0; i < count; ++i)
                line[x++][channel] = isRun ? static_cast<uint8_t>(value) : reader.byte();
        }
    }
}

/// Plain pixels, where (1, 1, 1, n) repeats the one before n times; following such codes count in higher bytes.
void readFlatLine(Reader& reader, std::span<Rgbe> line, const fs::path& path) {
    int shift = 0;
    for (size_t x = 0; x < line.size();) {
        const Rgbe pixel = reader.pixel();
        const bool isRun = pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1;
        if (!isRun) {
            line[x++] = pixel;
            shift = 0;
            continue;
        }
        const size_t count = size_t{pixel[3]} << shift;
        if (x == 0 || shift > 16 || count > line.size() - x) throwDamaged(path, "a run of pixels has a wrong length");
        std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(x), count, line[x - 1]);
        x += count;
        shift += 8;
    }
}

void decodePixel(const Rgbe& pixel, float* rgb) {
    const float step = pixel[3] ? std::ldexp(1.0f, pixel[3] - kExponentBias) : 0.0f;
    for (size_t c = 0; c < 3; ++c) rgb[c] = static_cast<float>(pixel[c]) * step;
}

float sanitize(float value) { return value > 0.0f ? std::min(value, kMaxValue) : 0.0f; }

Rgbe encodePixel(const float* rgb) {
    const std::array<float, 3> color = {sanitize(rgb[0]), sanitize(rgb[1]), sanitize(rgb[2])};
    const float largest = *std::ranges::max_element(color);
    int exponent = 0;
    const float mantissa = std::frexp(largest, &exponent);
    if (std::lround(mantissa * 256.0f) == 256) ++exponent;  // rounds up into the next power of two
    const int stored = exponent + kExponentBias - 8;
    if (largest == 0.0f || stored < 1) return {};
    Rgbe pixel{};
    for (size_t c = 0; c < 3; ++c) pixel[c] = static_cast<uint8_t>(std::lround(std::ldexp(color[c], 8 - exponent)));
    pixel[3] = static_cast<uint8_t>(stored);
    return pixel;
}

/// Length of the run of equal bytes that starts at `x`.
size_t runAt(std::span<const Rgbe> line, size_t channel, size_t x) {
    size_t end = x + 1;
    while (end < line.size() && end - x < kMaxRun && line[end][channel] == line[x][channel]) ++end;
    return end - x;
}

void appendChannelRuns(std::vector<std::byte>& file, std::span<const Rgbe> line, size_t channel) {
    for (size_t x = 0; x < line.size();) {
        const size_t run = runAt(line, channel, x);
        if (run >= kMinRun) {
            file.push_back(static_cast<std::byte>(kMaxLiteral + run));
            file.push_back(static_cast<std::byte>(line[x][channel]));
            x += run;
            continue;
        }
        size_t end = x;
        while (end < line.size() && end - x < kMaxLiteral && runAt(line, channel, end) < kMinRun) ++end;
        file.push_back(static_cast<std::byte>(end - x));
        for (; x < end; ++x) file.push_back(static_cast<std::byte>(line[x][channel]));
    }
}

void appendLine(std::vector<std::byte>& file, std::span<const Rgbe> line) {
    if (line.size() < kMinRunWidth || line.size() > kMaxRunWidth) {
        for (const Rgbe& pixel : line)
            for (const uint8_t value : pixel) file.push_back(static_cast<std::byte>(value));
        return;
    }
    for (const size_t value : {size_t{2}, size_t{2}, line.size() >> 8, line.size() & 0xff})
        file.push_back(static_cast<std::byte>(value));
    for (size_t channel = 0; channel < 4; ++channel) appendChannelRuns(file, line, channel);
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\\\";
        else if (c == '\n')
            result += "\\n";
        else if (c == '\r')
            result += "\\r";
        else
            result += c;
    }
    return result;
}

std::string header(const Bitmap& bitmap, const Metadata& metadata) {
    std::string text = "#?RADIANCE\n";
    for (const auto& [key, value] : metadata) text += "# raylab." + escaped(key) + "=" + escaped(value) + "\n";
    return text + "FORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(bitmap.height) + " +X " +
           std::to_string(bitmap.width) + "\n";
}

}  // namespace

Bitmap formats::decodeHdr(std::span<const std::byte> bytes, const fs::path& path) {
    Reader reader(bytes, path);
    Bitmap bitmap = readHeader(reader, path);
    std::vector<Rgbe> line(static_cast<size_t>(bitmap.width));
    const bool mayBeRunLength = bitmap.width >= kMinRunWidth && bitmap.width <= kMaxRunWidth;
    for (int y = 0; y < bitmap.height; ++y) {
        if (mayBeRunLength && reader.startsRunLengthLine())
            readRunLengthLine(reader, line, path);
        else
            readFlatLine(reader, line, path);
        for (int x = 0; x < bitmap.width; ++x) decodePixel(line[static_cast<size_t>(x)], bitmap.at(x, y));
    }
    return bitmap;
}

void writeHdr(const fs::path& path, const Bitmap& bitmap, const Metadata& metadata) {
    formats::requireWhole(bitmap, path);
    const std::string text = header(bitmap, metadata);
    const auto* textBytes = reinterpret_cast<const std::byte*>(text.data());
    std::vector<std::byte> file(textBytes, textBytes + text.size());
    std::vector<Rgbe> line(static_cast<size_t>(bitmap.width));
    for (int y = 0; y < bitmap.height; ++y) {
        for (int x = 0; x < bitmap.width; ++x) {
            const float* in = bitmap.at(x, y);
            const std::array<float, 3> grey = {in[0], in[0], in[0]};
            line[static_cast<size_t>(x)] = encodePixel(bitmap.channels == 1 ? grey.data() : in);
        }
        appendLine(file, line);
    }
    writeFileAtomically(path, file);
}

}  // namespace raylab
