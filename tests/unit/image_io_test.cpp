#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <functional>
#include <map>

#include "engine/image/image8.h"
#include "engine/image/image_io.h"
#include "image_test_support.h"

namespace raylab {
namespace {
using namespace imagetest;

using Writer = std::function<void(const fs::path&, const Bitmap&)>;

const std::map<std::string, Writer>& writers() {
    static const std::map<std::string, Writer> all = {
        {"a.png", [](const fs::path& path, const Bitmap& bitmap) { writePng(path, bitmap); }},
        {"a.hdr", [](const fs::path& path, const Bitmap& bitmap) { writeHdr(path, bitmap); }},
        {"a.exr", [](const fs::path& path, const Bitmap& bitmap) {
             writeExr(path, std::vector<Layer>{{"", bitmap}});
         }}};
    return all;
}

/// Files may not grow past `bytes` while this lives: what a full disk does, and it stops root too.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : oldHandler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &oldLimit_);
        const rlimit limit{bytes, oldLimit_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &oldLimit_);
        std::signal(SIGXFSZ, oldHandler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    rlimit oldLimit_{};
    void (*oldHandler_)(int);
};

TEST(ImageIo, WhatIsNoImageIsAnErrorThatNamesTheFile) {
    const ScratchFolder folder;
    const auto message = [](const fs::path& path) { return errorOf([&] { readImage(path); }); };
    EXPECT_NE(message(folder / "missing.png").find("missing.png: no such file"), std::string::npos);
    EXPECT_NE(message(folder.path()).find("is a folder"), std::string::npos);
    EXPECT_NE(message(putFile(folder / "empty.exr", "")).find("empty.exr: is empty"), std::string::npos);
    EXPECT_NE(message(putFile(folder / "text.png", "hello, world")).find("text.png: is no image"), std::string::npos);
    EXPECT_NE(message(putFile(folder / "text.tga", "hello, world")).find("text.tga"), std::string::npos);
    EXPECT_NE(errorOf([&] { readExrLayers(folder / "missing.exr"); }).find("no such file"), std::string::npos);
    EXPECT_NE(errorOf([&] { readExrLayers(folder / "text.png"); }).find("text.png"), std::string::npos);
    EXPECT_NE(errorOf([&] { readPngText(folder / "text.png"); }).find("is no PNG"), std::string::npos);
}

TEST(ImageIo, FormatIsKnownByContent) {
    const ScratchFolder folder;
    const Bitmap bitmap = randomBitmap(10, 6, 3, 1);
    for (const auto& [name, write] : writers()) {
        write(folder / name, bitmap);
        const fs::path renamed = folder / "image.bin";
        fs::rename(folder / name, renamed);
        EXPECT_EQ(readImage(renamed).width, 10) << name;
    }
}

TEST(ImageIo, MissingFoldersAreMadeAndFilesReplaced) {
    const ScratchFolder folder;
    for (const auto& [name, write] : writers()) {
        const fs::path path = folder / "new/folder" / name;
        write(path, Bitmap(2, 2, 3));
        write(path, Bitmap(5, 4, 3));
        EXPECT_EQ(readImage(path).width, 5) << name;
    }
}

TEST(ImageIo, PathBelowAFileIsAnError) {
    const ScratchFolder folder;
    putFile(folder / "file", "keep me");
    for (const auto& [name, write] : writers())
        EXPECT_NE(errorOf([&] { write(folder / "file" / name, Bitmap(2, 2, 3)); }).find(name), std::string::npos);
    EXPECT_EQ(fileBytes(folder / "file"), "keep me");
}

TEST(ImageIo, FullDiskLeavesTheOldFileAndNothingElse) {
    const ScratchFolder folder;
    const Bitmap bitmap = randomBitmap(200, 200, 3, 2);
    for (const auto& [name, write] : writers()) {
        putFile(folder / name, "old");
        std::string message;
        {
            const FileSizeLimit limit(20000);
            message = errorOf([&] { write(folder / name, bitmap); });
        }
        EXPECT_NE(message.find(name), std::string::npos) << message;
        EXPECT_EQ(fileBytes(folder / name), "old");
    }
    size_t entries = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.path())) entries += entry.is_regular_file();
    EXPECT_EQ(entries, writers().size());
}

TEST(ImageIo, EmptyOrInconsistentBitmapsAreNotWritten) {
    const ScratchFolder folder;
    Bitmap torn(4, 4, 3);
    torn.pixels.pop_back();
    for (const auto& [name, write] : writers())
        for (const Bitmap& bitmap : {Bitmap(), Bitmap(3, 0, 3), Bitmap(2, 2, 2), torn})
            EXPECT_NE(errorOf([&] { write(folder / name, bitmap); }), "") << name;
}

/// 3 x 1 BGR pixels after an 18-byte header; bit 5 of the last header byte says "top row first".
std::string handMadeTga() {
    return std::string("\0\0\x02\0\0\0\0\0\0\0\0\0\x03\0\x01\0\x18\x20", 18) +
           std::string("\0\0\xff\0\xff\0\xff\0\0", 9);
}

/// 1 x 2 pixels, bottom row first, rows padded to 4 bytes: red above blue.
std::string handMadeBmp() {
    const std::string info = littleEndian<uint32_t>(40) + littleEndian<int32_t>(1) + littleEndian<int32_t>(2) +
                             littleEndian<uint16_t>(1) + littleEndian<uint16_t>(24) + std::string(24, '\0');
    return "BM" + littleEndian<uint32_t>(62) + littleEndian<uint32_t>(0) + littleEndian<uint32_t>(54) + info +
           std::string("\xff\0\0\0\0\0\xff\0", 8);
}

TEST(ImageIo, HandMadeTgaAndBmp) {
    const ScratchFolder folder;
    EXPECT_EQ(readImage(putFile(folder / "a.tga", handMadeTga())).pixels,
              (std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1}));
    EXPECT_EQ(readImage(putFile(folder / "a.bmp", handMadeBmp())).pixels, (std::vector<float>{1, 0, 0, 0, 0, 1}));
}

TEST(ImageIo, TruncatedTgaAndBmpAreErrors) {
    const ScratchFolder folder;
    const std::string tga = handMadeTga(), bmp = handMadeBmp();
    for (size_t size = 0; size < tga.size(); ++size)
        EXPECT_NE(errorOf([&] { readImage(putFile(folder / "cut.tga", tga.substr(0, size))); }), "") << size;
    for (size_t size = 0; size + 1 < bmp.size(); ++size)  // the last byte is padding, which nobody needs
        EXPECT_NE(errorOf([&] { readImage(putFile(folder / "cut.bmp", bmp.substr(0, size))); }), "") << size;
}

TEST(ImageIo, RealJpegWholeAndTruncated) {
    const fs::path source = scenes() / "balloon" / "textures" / "material_10_baseColor.jpeg";
    if (!fs::exists(source)) GTEST_SKIP() << source << " is absent";
    const ScratchFolder folder;
    const std::string whole = fileBytes(source);
    std::string whyNot;
    const std::optional<Image8> image = decodeImage8(asBytes(whole), whyNot);
    ASSERT_TRUE(image) << whyNot;
    EXPECT_FALSE(image->hasAlpha);
    const Bitmap bitmap = readImage(source, Alpha::keep);
    EXPECT_EQ(bitmap.channels, 3);
    EXPECT_EQ(static_cast<uint32_t>(bitmap.width), image->width);
    EXPECT_EQ(static_cast<uint32_t>(bitmap.height), image->height);
    for (const size_t percent : {0, 1, 10, 50, 90, 99}) {
        const std::string cut = whole.substr(0, whole.size() * percent / 100);
        EXPECT_NE(errorOf([&] { readImage(putFile(folder / "cut.jpg", cut)); }), "") << percent;
        EXPECT_FALSE(decodeImage8(asBytes(cut), whyNot)) << percent;
    }
}

TEST(ImageIo, OverfullHuffmanTableIsRefused) {
    std::string whyNot;
    const std::string counts(16, '\xff');
    const std::string table = std::string("\xff\xc4\x0f\xf3\0", 5) + counts + std::string(255 * 16, '\0');
    EXPECT_FALSE(decodeImage8(asBytes("\xff\xd8" + table), whyNot));
    EXPECT_NE(whyNot.find("Huffman"), std::string::npos) << whyNot;
}

TEST(ImageIo, TinyFileThatClaimsMillionsOfPixelsIsRefused) {
    const ScratchFolder folder;
    std::string tga = handMadeTga();
    tga.replace(12, 4, "\x40\x1f\x40\x1f");
    EXPECT_NE(errorOf([&] { readImage(putFile(folder / "a.tga", tga)); }).find("8000 x 8000"), std::string::npos);
}

}  // namespace
}  // namespace raylab
