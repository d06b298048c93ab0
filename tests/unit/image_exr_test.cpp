#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "engine/image/image_io.h"
#include "image_test_support.h"

namespace raylab {
namespace {
using namespace imagetest;

std::vector<uint32_t> bitsOf(const Bitmap& bitmap) {
    std::vector<uint32_t> bits;
    for (const float value : bitmap.pixels) bits.push_back(std::bit_cast<uint32_t>(value));
    return bits;
}

TEST(ImageExr, RoundTripIsExactInAllLayersAndMetadata) {
    const ScratchFolder folder;
    std::vector<Layer> layers = {{"", randomBitmap(33, 21, 4, 1, 1000.0f)},
                                 {"samples", randomBitmap(33, 21, 1, 2)},
                                 {"variance", randomBitmap(33, 21, 3, 3)}};
    float* first = layers[0].bitmap.pixels.data();
    first[0] = std::numeric_limits<float>::infinity();
    first[1] = std::nanf("");
    first[2] = -1e-40f;
    first[3] = std::numeric_limits<float>::max();
    const Metadata metadata = {{"note", "one\ntwo \xe2\x86\x92"}, {"scene", "cornell.glb"}, {"seed", "7"}};
    writeExr(folder / "a.exr", layers, metadata);

    Metadata readMetadata = {{"left", "over"}};
    const std::vector<Layer> read = readExrLayers(folder / "a.exr", &readMetadata);
    EXPECT_EQ(readMetadata, metadata);
    ASSERT_EQ(read.size(), layers.size());
    for (size_t i = 0; i < layers.size(); ++i) {
        EXPECT_EQ(read[i].name, layers[i].name);
        EXPECT_EQ(read[i].bitmap.width, 33);
        EXPECT_EQ(read[i].bitmap.channels, layers[i].bitmap.channels);
        EXPECT_EQ(bitsOf(read[i].bitmap), bitsOf(layers[i].bitmap)) << layers[i].name;
    }
    EXPECT_EQ(bitsOf(readImage(folder / "a.exr", Alpha::keep)), bitsOf(layers[0].bitmap));
    const Bitmap withoutAlpha = readImage(folder / "a.exr");
    ASSERT_EQ(withoutAlpha.channels, 3);
    EXPECT_EQ(withoutAlpha.at(5, 7)[2], layers[0].bitmap.at(5, 7)[2]);
}

TEST(ImageExr, FileSaysWhatTheFormatAsks) {
    const ScratchFolder folder;
    const std::vector<Layer> layers = {{"", randomBitmap(5, 3, 3, 1)}, {"samples", randomBitmap(5, 3, 1, 2)}};
    writeExr(folder / "a.exr", layers, {{"seed", "7"}});
    const std::string file = fileBytes(folder / "a.exr");
    const auto contains = [&](const std::string& text) { return file.find(text) != std::string::npos; };
    EXPECT_TRUE(file.starts_with(littleEndian<uint32_t>(20000630) + littleEndian<uint32_t>(2)));
    EXPECT_TRUE(contains(exrAttribute("raylab.seed", "string", "7")));
    EXPECT_TRUE(contains(exrAttribute("compression", "compression", "\x03")));  // ZIP, 16 scan lines
    EXPECT_TRUE(contains("samples" + std::string(1, '\0') + littleEndian<int32_t>(2)));
    EXPECT_TRUE(contains(exrAttribute("dataWindow", "box2i",
                                      littleEndian<int64_t>(0) + littleEndian<int32_t>(4) + littleEndian<int32_t>(2))));
}

TEST(ImageExr, GreyMainLayer) {
    const ScratchFolder folder;
    const std::vector<Layer> layers = {{"", randomBitmap(4, 2, 1, 3)}};
    writeExr(folder / "a.exr", layers);
    const Bitmap bitmap = readImage(folder / "a.exr", Alpha::keep);
    ASSERT_EQ(bitmap.channels, 3);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(bitmap.at(3, 1)[c], layers[0].bitmap.at(3, 1)[0]);
}

/// One row of two pixels a channel; 0x3c00 and 0xc000 are 1 and -2 as half floats.
ExrPart handMadePart() {
    const auto floats = [](float a, float b) { return std::vector{littleEndian(a) + littleEndian(b)}; };
    return {"",
            -3,
            5,
            -2,
            5,
            {{"A", 2, floats(0.25f, 0.5f)},
             {"B", 1, {littleEndian<uint16_t>(0x3c00) + littleEndian<uint16_t>(0xc000)}},
             {"G", 2, floats(3.0f, 4.0f)},
             {"R", 2, floats(5.0f, 6.0f)},
             {"Z", 2, floats(7.0f, 8.0f)},
             {"albedo.B", 2, floats(9.0f, 10.0f)},
             {"albedo.G", 2, floats(11.0f, 12.0f)},
             {"albedo.R", 2, floats(13.0f, 14.0f)},
             {"light.key.R", 2, floats(15.0f, 16.0f)},
             {"samples", 0, {littleEndian<uint32_t>(17) + littleEndian<uint32_t>(4096)}}}};
}

TEST(ImageExr, HandMadeTypesLayersAndWindow) {
    const ScratchFolder folder;
    const fs::path path = putFile(folder / "a.exr", handMadeExr({handMadePart()}));
    const std::vector<Layer> layers = readExrLayers(path);
    std::string names;
    for (const Layer& layer : layers) names += layer.name + ":" + std::to_string(layer.bitmap.channels) + " ";
    ASSERT_EQ(names, ":4 Z:1 albedo:3 light.key:1 samples:1 ");
    EXPECT_EQ(layers[0].bitmap.pixels, (std::vector<float>{5.0f, 3.0f, 1.0f, 0.25f, 6.0f, 4.0f, -2.0f, 0.5f}));
    EXPECT_EQ(layers[2].bitmap.pixels, (std::vector<float>{13.0f, 11.0f, 9.0f, 14.0f, 12.0f, 10.0f}));
    EXPECT_EQ(layers[4].bitmap.pixels, (std::vector<float>{17.0f, 4096.0f}));
    EXPECT_EQ(readImage(path).pixels, (std::vector<float>{5.0f, 3.0f, 1.0f, 6.0f, 4.0f, -2.0f}));
}

TEST(ImageExr, HandMadeMultiPart) {
    const ScratchFolder folder;
    ExrPart beauty = handMadePart(), other = handMadePart();
    beauty.name = "beauty";
    other.name = "other";
    other.channels.erase(other.channels.begin() + 4, other.channels.begin() + 5);  // its Z
    const std::vector<Layer> layers = readExrLayers(putFile(folder / "a.exr", handMadeExr({beauty, other})));
    std::string names;
    for (const Layer& layer : layers) names += layer.name + " ";
    EXPECT_EQ(names, " Z albedo light.key samples other other.albedo other.light.key other.samples ");
    ASSERT_EQ(layers.size(), 9u);
    EXPECT_EQ(layers[5].bitmap.pixels, layers[0].bitmap.pixels);
}

TEST(ImageExr, WithoutMainLayerTheErrorListsTheOthers) {
    const ScratchFolder folder;
    const std::vector<Layer> layers = {{"albedo", randomBitmap(2, 2, 3, 1)}, {"samples", randomBitmap(2, 2, 1, 2)}};
    writeExr(folder / "a.exr", layers);
    EXPECT_EQ(readExrLayers(folder / "a.exr").size(), 2u);
    EXPECT_NE(errorOf([&] { readImage(folder / "a.exr"); }).find("'albedo', 'samples'"), std::string::npos);
}

TEST(ImageExr, RefusesLayersThatCannotBeTold) {
    const ScratchFolder folder;
    const auto message = [&](const std::vector<Layer>& layers) {
        return errorOf([&] { writeExr(folder / "a.exr", layers); });
    };
    const Bitmap small(2, 2, 3), large(3, 2, 3), two(2, 2, 2);
    EXPECT_NE(message({{"", small}, {"variance", large}}).find("3 x 2"), std::string::npos);
    EXPECT_NE(message({{"a", small}, {"a", small}}).find("'a'"), std::string::npos);
    EXPECT_NE(message({{"a.b", small}}), "");
    EXPECT_NE(message({{"R", small}}), "");
    EXPECT_NE(message({{"", two}}), "");
    EXPECT_NE(message({{"", Bitmap(0, 5, 3)}}), "");
    EXPECT_NE(message({}), "");
    EXPECT_FALSE(fs::exists(folder / "a.exr"));
}

TEST(ImageExr, EachTruncationIsAnErrorThatNamesTheFile) {
    const ScratchFolder folder;
    writeExr(folder / "whole.exr", std::vector<Layer>{{"", randomBitmap(3, 20, 3, 1)}}, {{"seed", "3"}});
    for (const std::string& whole : {fileBytes(folder / "whole.exr"), handMadeExr({handMadePart()})})
        for (size_t size = 0; size < whole.size(); ++size) {
            const fs::path path = putFile(folder / "cut.exr", whole.substr(0, size));
            EXPECT_NE(errorOf([&] { readImage(path); }).find("cut.exr"), std::string::npos) << size;
        }
}

TEST(ImageExr, AbsurdOrSubsampledIsAnError) {
    const ScratchFolder folder;
    ExrPart part = handMadePart();
    std::string file = handMadeExr({part});
    const size_t maxX = file.find("dataWindow") + std::string("dataWindow").size() + 1 + 6 + 4 + 8;
    file.replace(maxX, 4, littleEndian<int32_t>(2000000000));
    EXPECT_NE(errorOf([&] { readImage(putFile(folder / "huge.exr", file)); }).find("huge.exr"), std::string::npos);

    part.channels = {{"Y", 2, {littleEndian(1.0f), ""}, 2}};  // odd lines of the window store nothing
    part.minX = 0, part.maxX = 1, part.minY = 0, part.maxY = 1;
    const fs::path subsampled = putFile(folder / "chroma.exr", handMadeExr({part}));
    EXPECT_NE(errorOf([&] { readImage(subsampled); }).find("subsampled"), std::string::npos);
}

TEST(ImageExr, MitsubaReferencesAgreeWithAnotherReader) {
    const fs::path folder = scenes() / "mitsuba-refs";
    if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
    size_t files = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".exr") continue;
        ++files;
        const std::vector<Layer> layers = readExrLayers(entry.path());
        ASSERT_EQ(layers.size(), 1u) << entry.path();
        EXPECT_EQ(layers[0].name, "");
        EXPECT_EQ(layers[0].bitmap.channels, 3);
        for (const float value : layers[0].bitmap.pixels) ASSERT_TRUE(std::isfinite(value)) << entry.path();
    }
    EXPECT_EQ(files, 19u);

    // Taken in Python from blocks that the files store without compression.
    const Bitmap environment = readImage(folder / "bsdf_spheres" / "refs" / "test_envmap_ref_rgb.exr");
    EXPECT_EQ(environment.at(24, 24)[0], 0.40739625692367554f);
    EXPECT_EQ(environment.at(5, 40)[1], 0.2047673761844635f);
    EXPECT_EQ(environment.at(47, 47)[2], 0.04888413846492767f);
    const Bitmap mirrors = readImage(folder / "infinite_mirrors" / "refs" / "scene_ref_rgb_var.exr");
    EXPECT_EQ(mirrors.at(16, 16)[0], 0.004374771378934383f);
    EXPECT_EQ(mirrors.at(5, 8)[2], 0.000294718483928591f);
}

}  // namespace
}  // namespace raylab
