#include <algorithm>
#include <array>
#include <ctime>
#include <new>
#include <random>

#include "engine/image/image_io.h"
#include "tests/support/fuzz.h"
#include "tests/unit/import_support.h"

/// Damaged copies of small files of every kind that is read: what comes of each is a scene (or a picture) that keeps
/// its promises, or an Error. A crash ends this test's own process; the file that it was reading is then in the
/// temporary folder.
namespace raylab::importtest {
namespace {

constexpr double kMostSeconds = 10.0;  ///< of CPU time a file

using Engine = std::mt19937;

size_t below(Engine& engine, size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(engine); }

void flipBits(std::string& bytes, Engine& engine) {
    for (size_t i = 1 + below(engine, 8); i > 0; --i)
        bytes[below(engine, bytes.size())] ^= static_cast<char>(1u << below(engine, 8));
}

void overwriteWord(std::string& bytes, Engine& engine) {
    constexpr std::array<uint32_t, 8> kWords = {0u,          1u,       0xffffffffu, 0x7fffffffu,
                                                0x80000000u, 0x10000u, 0x7fc00000u, 0x7f7fffffu};
    const uint32_t word = kWords[below(engine, kWords.size())];
    if (bytes.size() < sizeof(word)) return;
    std::memcpy(bytes.data() + below(engine, bytes.size() - sizeof(word) + 1), &word, sizeof(word));
}

void cutShort(std::string& bytes, Engine& engine) { bytes.resize(below(engine, bytes.size())); }

void removePiece(std::string& bytes, Engine& engine) {
    const size_t at = below(engine, bytes.size());
    bytes.erase(at, 1 + below(engine, 32));
}

void repeatPiece(std::string& bytes, Engine& engine) {
    const size_t at = below(engine, bytes.size());
    const std::string piece = bytes.substr(at, 1 + below(engine, 64));
    for (size_t i = 1 + below(engine, 4); i > 0; --i) bytes.insert(at, piece);
}

/// Another number in place of one that is written in digits.
void replaceNumber(std::string& bytes, Engine& engine) {
    constexpr std::array kNumbers = {"-1",   "0",      "4294967295", "4294967296", "99999999999999999999",
                                     "1e39", "-1e308", "nan",        "inf",        "1.5",
                                     "",     "0x7",    "\"a\"",      "null",       "[]"};
    const size_t from = bytes.find_first_of("0123456789", below(engine, bytes.size()));
    if (from == std::string::npos) return;
    const size_t to = std::min(bytes.find_first_not_of("0123456789.-+e", from), bytes.size());
    bytes.replace(from, to - from, kNumbers[below(engine, kNumbers.size())]);
}

/// Two pieces change places.
void swapPieces(std::string& bytes, Engine& engine) {
    const size_t length = 1 + below(engine, 32);
    if (bytes.size() < 2 * length) return;
    const size_t a = below(engine, bytes.size() - length), b = below(engine, bytes.size() - length);
    for (size_t i = 0; i < length; ++i) std::swap(bytes[a + i], bytes[b + i]);
}

std::string damaged(std::string bytes, uint32_t seed) {
    constexpr std::array kDamages = {flipBits,    overwriteWord, cutShort,      removePiece,
                                     repeatPiece, replaceNumber, replaceNumber, swapPieces};
    Engine engine(seed);
    for (size_t i = 1 + below(engine, 3); i > 0 && !bytes.empty(); --i)
        kDamages[below(engine, kDamages.size())](bytes, engine);
    return bytes;
}

std::string contentsOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Damages `victim` again and again and reads `opened`, by `read`. Both are as they were in between.
class Fuzz {
public:
    Fuzz(const ScratchFolder& folder, fs::path opened, fs::path victim)
        : folder_(folder), opened_(std::move(opened)), victim_(std::move(victim)), whole_(contentsOf(victim_)) {}

    template <class Read>
    void run(uint32_t rounds, const Read& read) {
        SCOPED_TRACE(victim_.filename().string());
        ASSERT_FALSE(whole_.empty());
        ASSERT_TRUE(once(read, whole_)) << "the undamaged file is not read";
        size_t readable = 0;
        for (uint32_t seed = 1; seed <= rounds * support::fuzzRepeats() && !::testing::Test::HasFailure(); ++seed) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            readable += once(read, damaged(whole_, seed)) ? 1u : 0u;
        }
        ::testing::Test::RecordProperty("readable", static_cast<int>(readable));
        folder_.write(victim_.filename().string(), whole_);
    }

private:
    /// Whether the file was read.
    template <class Read>
    bool once(const Read& read, const std::string& bytes) {
        folder_.write(victim_.filename().string(), bytes);
        const std::clock_t start = std::clock();
        bool isRead = false;
        try {
            read(opened_);
            isRead = true;
        } catch (const Error& error) {
            EXPECT_EQ(error.exitCode(), ExitCode::badInput) << error.what();
        } catch (const std::exception& error) {
            ADD_FAILURE() << "not an Error: " << error.what();
        }
        EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, kMostSeconds);
        return isRead;
    }

    const ScratchFolder& folder_;
    fs::path opened_, victim_;
    std::string whole_;
};

void readScene(const fs::path& file) { expectSound(importScene(file)); }

void readPicture(const fs::path& file) {
    const Bitmap image = readImage(file);
    EXPECT_EQ(image.pixels.size(), static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * 3u);
}

Bitmap gradient() {
    Bitmap image(9, 7, 3);
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i) / 189.0f;
    return image;
}

/// A mesh with texture coordinates, tangents, indices and all lobes, a picture, a light, a camera and a quadric.
Gltf richGltf(const ScratchFolder& folder) {
    writePng(folder.path() / "picture.png", gradient());
    Gltf gltf;
    nlohmann::json primitive = gltf.trianglePrimitive();
    primitive["attributes"]["NORMAL"] = gltf.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
    primitive["attributes"]["TANGENT"] = gltf.accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 5126, "VEC4", 3);
    primitive["indices"] = gltf.indices({0, 1, 2});
    primitive["material"] = 0;
    gltf.mesh(primitive);
    gltf.json["images"] = {{{"uri", "picture.png"}}};
    gltf.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    gltf.json["samplers"] = {{{"wrapS", 33071}}};
    gltf.json["materials"] = {
        {{"name", "all"},
         {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0.5}}},
         {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.25},
         {"extensions",
          {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}}}, {"KHR_materials_ior", {{"ior", 1.4}}}}}}};
    gltf.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_clearcoat", "KHR_materials_ior"};
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 3.0}, {"spot", {{"outerConeAngle", 0.5}}}}};
    gltf.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    gltf.json["nodes"] = {{{"mesh", 0}, {"children", {1, 2}}, {"translation", {1.0, 2.0, 3.0}}},
                          {{"camera", 0}, {"rotation", {0.0, 0.0, 0.0, 1.0}}},
                          {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"scale", {1.0, 2.0, 1.0}}}};
    return gltf;
}

using ImportFuzz = ::testing::Test;

TEST_F(ImportFuzz, Gltf) {
    const ScratchFolder folder;
    const fs::path file = richGltf(folder).write(folder);
    Fuzz(folder, file, file).run(400, readScene);
    Fuzz(folder, file, folder.path() / "scene.bin").run(100, readScene);
    Fuzz(folder, file, folder.path() / "picture.png").run(100, readScene);
}

TEST_F(ImportFuzz, Glb) {
    const ScratchFolder folder;
    const fs::path file = folder.write("scene.glb", richGltf(folder).glb());
    Fuzz(folder, file, file).run(400, readScene);
}

/// With our own extras: quadrics, Phong materials, sun, environment.
TEST_F(ImportFuzz, ExtrasOfOurOwn) {
    const ScratchFolder folder;
    writeHdr(folder.path() / "sky.hdr", gradient());
    Gltf gltf = richGltf(folder);
    gltf.json["nodes"].push_back({{"extras", {{"raylab", {{"quadrics", 0}}}}}});
    gltf.json["scenes"] = {{{"nodes", {0, 3}}}};
    gltf.json["materials"][0]["extras"]["raylab"]["phong"] = {{"diffuse", {0.5, 0.5, 0.5}}, {"exponent", 20}};
    gltf.json["extras"]["raylab"] = {{"sun", {{"elevation", 38}, {"azimuth", 104}, {"turbidity", 2.5}, {"scale", 1}}},
                                     {"environment", "sky.hdr"},
                                     {"environmentScale", 1},
                                     {"quadrics",
                                      {{{"material", 0},
                                        {"surfaces",
                                         {{{"kind", "paraboloid"}, {"radii", {1, 1, 1}}, {"clip", {0, 0.8}}},
                                          {{"kind", "sphere"}, {"radius", 0.3}}}}}}}};
    const fs::path file = gltf.write(folder);
    Fuzz(folder, file, file).run(400, readScene);
    Fuzz(folder, file, folder.path() / "sky.hdr").run(50, readScene);
}

TEST_F(ImportFuzz, ObjAndMtl) {
    const ScratchFolder folder;
    writePng(folder.path() / "picture.png", gradient());
    const fs::path materials = folder.write(
        "scene.mtl",
        "newmtl one\nKd 0.8 0.2 0.1\nKs 0.5 0.5 0.5\nNs 20\nmap_Kd picture.png\nd 0.5\nnewmtl two\nKe 1 2 3\n");
    const fs::path file =
        folder.write("scene.obj",
                     "mtllib scene.mtl\no a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nvt 0 0\nvt 1 0\nvt 1 1\n"
                     "vn 0 0 1\nusemtl one\nf 1/1/1 2/2/1 3/3/1 4/1/1\ng b\nusemtl two\nf -1//1 -2//1 -3//1\n"
                     "s 1\nf 1 2 3\n");
    Fuzz(folder, file, file).run(300, readScene);
    Fuzz(folder, file, materials).run(150, readScene);
}

TEST_F(ImportFuzz, Ply) {
    const ScratchFolder folder;
    const std::string vertices =
        "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n";
    const std::string faces = "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const fs::path text = folder.write("text.ply", "ply\nformat ascii 1.0\ncomment a\n" + vertices + faces +
                                                       "0 0 0 9\n1 0 0 8\n1 1 0 7\n0 1 0 6\n3 0 1 2\n4 0 1 2 3\n");
    Fuzz(folder, text, text).run(300, readScene);
    std::string body;
    for (const float at : {0.0f, 1.0f, 2.0f, 3.0f}) body += bytesOf<float>({at, at * at, 1.0f - at}) + "\x05";
    for (const uint32_t first : {0u, 1u}) body += "\x03" + bytesOf<uint32_t>({first, first + 1, first + 2});
    const fs::path binary =
        folder.write("binary.ply", "ply\nformat binary_little_endian 1.0\n" + vertices + faces + body);
    Fuzz(folder, binary, binary).run(300, readScene);
}

TEST_F(ImportFuzz, Stl) {
    const ScratchFolder folder;
    const fs::path text = folder.write("text.stl",
                                       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 "
                                       "1 0\nendloop\nendfacet\nendsolid a\n");
    Fuzz(folder, text, text).run(200, readScene);
    std::string bytes(80, ' ');
    bytes += bytesOf<uint32_t>({2});
    for (const float at : {0.0f, 1.0f})
        bytes += bytesOf<float>({0, 0, 1, at, 0, 0, 1, at, 0, 0, 1, at}) + std::string(2, '\0');
    const fs::path binary = folder.write("binary.stl", bytes);
    Fuzz(folder, binary, binary).run(200, readScene);
}

TEST_F(ImportFuzz, Images) {
    const ScratchFolder folder;
    writePng(folder.path() / "a.png", gradient(), {{"seed", "7"}});
    writeHdr(folder.path() / "a.hdr", gradient(), {{"seed", "7"}});
    const Bitmap one(9, 7, 1);
    writeExr(folder.path() / "a.exr", std::array{Layer{"", gradient()}, Layer{"samples", one}}, {{"seed", "7"}});
    for (const char* name : {"a.png", "a.hdr", "a.exr"})
        Fuzz(folder, folder.path() / name, folder.path() / name).run(300, readPicture);
    Fuzz(folder, folder.path() / "a.exr", folder.path() / "a.exr").run(200, [](const fs::path& file) {
        Metadata metadata;
        readExrLayers(file, &metadata);
    });
    Fuzz(folder, folder.path() / "a.png", folder.path() / "a.png").run(200, [](const fs::path& file) {
        readPngText(file);
    });
}

}  // namespace
}  // namespace raylab::importtest
