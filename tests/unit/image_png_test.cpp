#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/image/image8.h"
#include "engine/image/image_io.h"
#include "engine/image/srgb.h"
#include "image_test_support.h"

namespace raylab {
namespace {
using namespace imagetest;

struct Chunk {
    std::string type, data;
    bool intact;
};

/// Reads a PNG file's chunks with a CRC of its own.
std::vector<Chunk> chunksOf(const std::string& file) {
    const auto number = [&](size_t offset) {
        uint32_t value = 0;
        for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(file.at(offset + i));
        return value;
    };
    std::vector<Chunk> chunks;
    for (size_t offset = 8; offset < file.size();) {
        const uint32_t length = number(offset);
        const std::string body = file.substr(offset + 4, length + size_t{4});
        chunks.push_back({body.substr(0, 4), body.substr(4), bitwiseCrc(body) == number(offset + 8 + length)});
        offset += length + size_t{12};
    }
    return chunks;
}

TEST(ImagePng, RoundTripWithinHalfAStep) {
    const ScratchFolder folder;
    const Bitmap bitmap = randomBitmap(61, 37, 3, 1);
    writePng(folder / "a.png", bitmap);
    const Bitmap read = readImage(folder / "a.png");
    ASSERT_EQ(read.width, 61);
    ASSERT_EQ(read.height, 37);
    ASSERT_EQ(read.channels, 3);
    for (size_t i = 0; i < bitmap.pixels.size(); ++i)
        ASSERT_NEAR(linearToSrgb(read.pixels[i]), linearToSrgb(bitmap.pixels[i]), 0.5f / 255.0f + 1e-5f) << i;
}

TEST(ImagePng, AlphaIsLinearAndKeptOnRequest) {
    const ScratchFolder folder;
    Bitmap bitmap(1, 1, 4);
    bitmap.pixels = {0.5f, 0.18f, 0.0f, 0.5f};
    writePng(folder / "a.png", bitmap);
    const Bitmap kept = readImage(folder / "a.png", Alpha::keep);
    ASSERT_EQ(kept.channels, 4);
    EXPECT_FLOAT_EQ(kept.pixels[3], 128.0f / 255.0f);
    EXPECT_EQ(linearToSrgb8(kept.pixels[0]), 188);
    EXPECT_EQ(linearToSrgb8(kept.pixels[1]), 118);
    EXPECT_EQ(readImage(folder / "a.png").channels, 3);

    std::string whyNot;
    const std::string file = fileBytes(folder / "a.png");
    const std::optional<Image8> stored = decodeImage8(asBytes(file), whyNot);
    ASSERT_TRUE(stored) << whyNot;
    EXPECT_EQ(stored->texels.at(0), 188u | 118u << 8 | 128u << 24);
    EXPECT_TRUE(stored->hasAlpha);
}

TEST(ImagePng, GreyAndValuesOutOfRange) {
    const ScratchFolder folder;
    Bitmap bitmap(5, 1, 1);
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    bitmap.pixels = {std::nanf(""), -1.0f, kInfinite, 2.0f, -kInfinite};
    writePng(folder / "a.png", bitmap);
    const Bitmap read = readImage(folder / "a.png", Alpha::keep);
    ASSERT_EQ(read.channels, 3);
    const float expected[] = {0.0f, 0.0f, 1.0f, 1.0f, 0.0f};
    for (int x = 0; x < 5; ++x)
        for (int c = 0; c < 3; ++c) EXPECT_EQ(read.at(x, 0)[c], expected[x]) << x;
}

TEST(ImagePng, MetadataRoundTripInTheRightChunks) {
    const ScratchFolder folder;
    const Metadata metadata = {{"scene", "cornell.glb"},
                               {"seed", "7"},
                               {"author", "Andr\xc3\xa9"},
                               {"note", "\xe2\x86\x92 \xe6\x97\xa5"},
                               {"empty", ""},
                               {"lines", "one\ntwo"},
                               {"seed", "again"},
                               {"mixed", "\xc3\xa9\xe2\x86\x92"}};
    writePng(folder / "a.png", randomBitmap(4, 3, 3, 2), metadata);
    EXPECT_EQ(readPngText(folder / "a.png"), metadata);

    const std::vector<Chunk> chunks = chunksOf(fileBytes(folder / "a.png"));
    std::string types;
    for (const Chunk& chunk : chunks) {
        EXPECT_TRUE(chunk.intact) << chunk.type;
        types += chunk.type + " ";
    }
    EXPECT_EQ(types, "IHDR sRGB tEXt tEXt tEXt iTXt tEXt tEXt tEXt iTXt IDAT IEND ");
    EXPECT_EQ(chunks.at(2).data, std::string("scene\0cornell.glb", 17));
    EXPECT_EQ(chunks.at(4).data, std::string("author\0Andr\xe9", 12));
    EXPECT_EQ(chunks.at(5).data, std::string("note\0\0\0\0\0\xe2\x86\x92 \xe6\x97\xa5", 16));
    EXPECT_EQ(readImage(folder / "a.png").width, 4);
}

TEST(ImagePng, RefusesKeysThatPngForbids) {
    const ScratchFolder folder;
    const Bitmap bitmap(1, 1, 3);
    for (const std::string& key : {std::string(), std::string(80, 'k'), std::string(" a"), std::string("a  b"),
                                   std::string("a\nb"), std::string("\xe2\x86\x92")})
        EXPECT_NE(errorOf([&] { writePng(folder / "a.png", bitmap, {{key, "value"}}); }), "") << key;
    EXPECT_NE(errorOf([&] { writePng(folder / "a.png", bitmap, {{"key", std::string(2, '\0')}}); }), "");
    EXPECT_FALSE(fs::exists(folder / "a.png"));
}

TEST(ImagePng, HandMade16Bit) {
    const ScratchFolder folder;
    const std::string row("\0\x80\x00\x12\x34\xff\xff\x00\x01\x00\x00\x0a\xcf", 13);
    const Bitmap bitmap = readImage(putFile(folder / "a.png", handMadePng(2, 1, 16, 2, row)));
    ASSERT_EQ(bitmap.width, 2);
    const int stored[] = {0x8000, 0x1234, 0xffff, 1, 0, 0x0acf};
    for (size_t i = 0; i < 6; ++i) {
        const double encoded = stored[i] / 65535.0;
        const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(bitmap.pixels[i], linear, 1e-6 * linear + 1e-9) << i;
    }
}

TEST(ImagePng, HandMadeGreyWithAlpha) {
    const ScratchFolder folder;
    const fs::path path = putFile(folder / "a.png", handMadePng(1, 2, 8, 4, std::string("\0\x80\x40\0\x00\xff", 6)));
    const Bitmap bitmap = readImage(path, Alpha::keep);
    ASSERT_EQ(bitmap.channels, 4);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(bitmap.at(0, 0)[c], 0.21586050, 1e-7);
    EXPECT_FLOAT_EQ(bitmap.at(0, 0)[3], 64.0f / 255.0f);
    EXPECT_EQ(bitmap.at(0, 1)[3], 1.0f);
    EXPECT_EQ(readImage(path).channels, 3);
}

TEST(ImagePng, DecodeImage8KeepsStoredBytesInOrder) {
    std::string whyNot;
    const std::string rgb = handMadePng(2, 1, 8, 2, std::string("\0\x01\x02\x03\xff\x80\x00", 7));
    const std::optional<Image8> image = decodeImage8(asBytes(rgb), whyNot);
    ASSERT_TRUE(image) << whyNot;
    EXPECT_EQ(image->width, 2u);
    EXPECT_EQ(image->height, 1u);
    EXPECT_EQ(image->texels, (std::vector<uint32_t>{0xff030201u, 0xff0080ffu}));
    EXPECT_FALSE(image->hasAlpha);

    const std::string opaque = handMadePng(1, 1, 8, 6, std::string("\0\x01\x02\x03\xff", 5));
    EXPECT_FALSE(decodeImage8(asBytes(opaque), whyNot)->hasAlpha);
    const std::string clear = handMadePng(1, 1, 8, 6, std::string("\0\x01\x02\x03\xfe", 5));
    EXPECT_TRUE(decodeImage8(asBytes(clear), whyNot)->hasAlpha);
}

TEST(ImagePng, DecodeImage8SaysWhyNot) {
    const auto reason = [](const std::string& file) {
        std::string whyNot;
        EXPECT_FALSE(decodeImage8(asBytes(file), whyNot));
        return whyNot;
    };
    const std::string good = handMadePng(1, 1, 8, 2, std::string("\0\x01\x02\x03", 4));
    EXPECT_EQ(reason(""), "is empty");
    EXPECT_NE(reason("certainly no image at all").find("no PNG, JPEG, BMP or TGA"), std::string::npos);
    EXPECT_EQ(reason(good.substr(0, good.size() - 15)), "is cut short");
    std::string flipped = good;
    flipped[8 + 25 + 8 + 8] ^= 1;
    EXPECT_NE(reason(flipped).find("checksum of its IDAT"), std::string::npos);
    const std::string huge = handMadePng(13000, 13000, 8, 2, "");
    EXPECT_NE(reason(huge).find("claims 13000 x 13000"), std::string::npos);
    EXPECT_NE(reason("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n....").find("no PNG"), std::string::npos);
}

TEST(ImagePng, EachTruncationIsAnErrorThatNamesTheFile) {
    const ScratchFolder folder;
    writePng(folder / "whole.png", randomBitmap(9, 5, 3, 3), {{"seed", "3"}});
    const std::string whole = fileBytes(folder / "whole.png");
    const fs::path path = folder / "cut.png";
    for (size_t size = 0; size < whole.size(); ++size) {
        putFile(path, whole.substr(0, size));
        EXPECT_NE(errorOf([&] { readImage(path); }).find("cut.png"), std::string::npos) << size;
        EXPECT_NE(errorOf([&] { readPngText(path); }).find("cut.png"), std::string::npos) << size;
    }
}

TEST(ImagePng, EachDamagedByteOfThePixelsIsNoticed) {
    const ScratchFolder folder;
    writePng(folder / "whole.png", randomBitmap(6, 4, 3, 4));
    const std::string whole = fileBytes(folder / "whole.png");
    const size_t begin = whole.find("IDAT");
    for (size_t i = begin; i + 12 < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x20);
        const fs::path path = putFile(folder / "damaged.png", damaged);
        EXPECT_NE(errorOf([&] { readImage(path); }), "") << i;
    }
}

}  // namespace
}  // namespace raylab
