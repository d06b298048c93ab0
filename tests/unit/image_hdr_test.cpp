#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/image/image_io.h"
#include "image_test_support.h"

namespace raylab {
namespace {
using namespace imagetest;

/// Checks |read - written| <= 2^-8 of the pixel's largest channel.
void expectWithinRgbeStep(const Bitmap& read, const Bitmap& written) {
    ASSERT_EQ(read.width, written.width);
    ASSERT_EQ(read.height, written.height);
    ASSERT_EQ(read.channels, 3);
    for (int y = 0; y < read.height; ++y)
        for (int x = 0; x < read.width; ++x) {
            const float* expected = written.at(x, y);
            const float largest = std::max({expected[0], expected[1], expected[2]});
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(read.at(x, y)[c], expected[c], largest * 0x1p-8f) << x << " " << y << " " << c;
        }
}

TEST(ImageHdr, RoundTripAtEachKindOfWidth) {
    const ScratchFolder folder;
    for (const int width : {1, 7, 8, 9, 127, 128, 129, 300, 33000}) {
        const Bitmap bitmap = randomBitmap(width, 3, 3, static_cast<uint32_t>(width), 50.0f);
        writeHdr(folder / "a.hdr", bitmap);
        expectWithinRgbeStep(readImage(folder / "a.hdr"), bitmap);
    }
}

TEST(ImageHdr, RoundTripOverTheWholeRange) {
    const ScratchFolder folder;
    std::mt19937 generator(5);
    std::uniform_real_distribution<float> exponent(-120.0f, 126.9f);
    Bitmap bitmap = randomBitmap(64, 64, 3, 6);
    for (float& value : bitmap.pixels) value *= std::exp2(exponent(generator));
    writeHdr(folder / "a.hdr", bitmap);
    expectWithinRgbeStep(readImage(folder / "a.hdr"), bitmap);
}

TEST(ImageHdr, RunsOfAllLengthsCompress) {
    const ScratchFolder folder;
    Bitmap bitmap(2000, 1, 3);
    for (int x = 0, run = 1, left = 1; x < bitmap.width; ++x) {
        std::fill_n(bitmap.at(x, 0), 3, std::exp2(static_cast<float>(run % 5)));
        if (--left == 0) left = ++run;
    }
    Bitmap flat(2000, 50, 3);
    std::ranges::fill(flat.pixels, 0.75f);
    writeHdr(folder / "runs.hdr", bitmap);
    writeHdr(folder / "flat.hdr", flat);
    EXPECT_EQ(readImage(folder / "runs.hdr").pixels, bitmap.pixels);
    EXPECT_EQ(readImage(folder / "flat.hdr").pixels, flat.pixels);
    EXPECT_LT(fs::file_size(folder / "flat.hdr"), 2000u * 50u * 4u / 50u);
}

TEST(ImageHdr, KnownBytes) {
    const ScratchFolder folder;
    Bitmap bitmap(1, 1, 3);
    bitmap.pixels = {1.0f, 0.5f, 0.25f};
    writeHdr(folder / "a.hdr", bitmap);
    EXPECT_EQ(fileBytes(folder / "a.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x81");
    bitmap.pixels = {0.9999f, 0.0f, 0.0f};  // rounds up into the next power of two
    writeHdr(folder / "a.hdr", bitmap);
    EXPECT_TRUE(fileBytes(folder / "a.hdr").ends_with(std::string("\x80\0\0\x81", 4)));
    EXPECT_EQ(readImage(folder / "a.hdr").pixels[0], 1.0f);
}

TEST(ImageHdr, ValuesThatTheFormatCannotHold) {
    const ScratchFolder folder;
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    Bitmap bitmap(3, 1, 3);
    bitmap.pixels = {std::nanf(""), -3.0f,  2.0f, kInfinite, std::numeric_limits<float>::max(),
                     -kInfinite,    1e-42f, 0.0f, 0.0f};
    writeHdr(folder / "a.hdr", bitmap);
    const Bitmap read = readImage(folder / "a.hdr");
    const float highest = 255.0f * 0x1p119f;
    EXPECT_EQ(read.pixels, (std::vector<float>{0.0f, 0.0f, 2.0f, highest, highest, 0.0f, 0.0f, 0.0f, 0.0f}));
}

TEST(ImageHdr, GreyAndAlpha) {
    const ScratchFolder folder;
    Bitmap grey(1, 1, 1);
    grey.pixels = {0.5f};
    writeHdr(folder / "a.hdr", grey);
    EXPECT_EQ(readImage(folder / "a.hdr", Alpha::keep).pixels, (std::vector<float>{0.5f, 0.5f, 0.5f}));
    Bitmap rgba(1, 1, 4);
    rgba.pixels = {1.0f, 0.5f, 0.25f, 0.0f};
    writeHdr(folder / "a.hdr", rgba);
    EXPECT_EQ(readImage(folder / "a.hdr", Alpha::keep).pixels, (std::vector<float>{1.0f, 0.5f, 0.25f}));
}

TEST(ImageHdr, MetadataAreCommentLines) {
    const ScratchFolder folder;
    writeHdr(folder / "a.hdr", randomBitmap(3, 2, 3, 7),
             {{"scene", "C:\\new"}, {"note", "one\n\n-Y 9 +X 9\r\ntwo"}, {"FORMAT", "other"}});
    const std::string file = fileBytes(folder / "a.hdr");
    EXPECT_EQ(file.substr(0, file.find("\n\n")),
              "#?RADIANCE\n# raylab.scene=C:\\\\new\n# raylab.note=one\\n\\n-Y 9 +X 9\\r\\ntwo\n# raylab.FORMAT=other\n"
              "FORMAT=32-bit_rle_rgbe");
    EXPECT_EQ(readImage(folder / "a.hdr").width, 3);
}

TEST(ImageHdr, HandMadeOldRunLengths) {
    const ScratchFolder folder;
    const std::string header = "#?RGBE\nEXPOSURE=1\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 270\n";
    const std::string pixel = "\x80\x40\x20\x81", runOf13("\1\1\1\x0d", 4), runOf256("\1\1\1\1", 4);
    const Bitmap bitmap = readImage(putFile(folder / "a.hdr", header + pixel + runOf13 + runOf256));
    ASSERT_EQ(bitmap.width, 270);
    for (int x = 0; x < 270; ++x) ASSERT_EQ(bitmap.at(x, 0)[1], 0.5f) << x;
}

TEST(ImageHdr, EachTruncationIsAnErrorThatNamesTheFile) {
    const ScratchFolder folder;
    for (const int width : {4, 11}) {
        writeHdr(folder / "whole.hdr", randomBitmap(width, 4, 3, 8), {{"seed", "3"}});
        const std::string whole = fileBytes(folder / "whole.hdr");
        for (size_t size = 0; size < whole.size(); ++size) {
            const fs::path path = putFile(folder / "cut.hdr", whole.substr(0, size));
            EXPECT_NE(errorOf([&] { readImage(path); }).find("cut.hdr"), std::string::npos) << size;
        }
    }
}

TEST(ImageHdr, DamageIsAnError) {
    const ScratchFolder folder;
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    const auto message = [&](const std::string& file) {
        return errorOf([&] { readImage(putFile(folder / "a.hdr", file)); });
    };
    const std::string zeros(100, '\0');
    EXPECT_NE(message(header + "-Y 1 +X 8\n" + std::string("\2\2\0\x08\0", 5) + zeros).find("run of pixels"),
              std::string::npos);
    EXPECT_NE(message(header + "-Y 1 +X 8\n\2\2" + std::string("\0\x08\x89", 3) + zeros).find("run of"),
              std::string::npos);
    EXPECT_NE(message(header + "-Y 1 +X 8\n\2\2" + std::string("\0\x09", 2) + zeros).find("scan line"),
              std::string::npos);
    EXPECT_NE(message(header + "-Y 1 +X 4\n\1\1\1\1" + zeros).find("run of pixels"), std::string::npos);
    EXPECT_NE(message(header + "-Y 99999 +X 99999\n" + zeros).find("99999 x 99999"), std::string::npos);
    EXPECT_NE(message(header + "-Y -1 +X 8\n" + zeros).find("8 x -1"), std::string::npos);
    EXPECT_NE(message(header + "+X 8 -Y 8\n" + zeros).find("-Y height +X width"), std::string::npos);
    EXPECT_NE(message("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + zeros).find("FORMAT"), std::string::npos);
}

TEST(ImageHdr, RealPanoramaAgreesWithAnotherReader) {
    const fs::path path = scenes() / "materialtest-envmap" / "envmap.hdr";
    if (!fs::exists(path)) GTEST_SKIP() << path << " is absent";
    const Bitmap bitmap = readImage(path);
    ASSERT_EQ(bitmap.width, 1024);
    ASSERT_EQ(bitmap.height, 512);
    double sums[3] = {};
    for (size_t i = 0; i < bitmap.pixels.size(); ++i) sums[i % 3] += static_cast<double>(bitmap.pixels[i]);
    // Decoded in Python from the format's description.
    const double means[] = {0.6151301477492552, 0.5669699950225322, 0.5863775678736829};
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sums[c] / (1024.0 * 512.0), means[c], 1e-9);
    EXPECT_EQ(bitmap.at(0, 0)[0], 0.2177734375f);
    EXPECT_EQ(bitmap.at(341, 256)[2], 0.2890625f);
}

}  // namespace
}  // namespace raylab
