#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <thread>

#include "engine/accel/build_binned.h"
#include "engine/accel/bvh_cache.h"
#include "engine/accel/triangle_bounds.h"
#include "tests/support/scratch_folder.h"
#include "tests/unit/accel_support.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;
using accel_test::TestMesh;

class AccelCache : public testing::Test {
protected:
    const support::ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path();
};

struct Built {
    BvhCacheKey key;
    Bvh bvh;
};

Built buildSoup(size_t count, uint32_t seed) {
    const TestMesh mesh = accel_test::randomSoup(count, 0.05f, seed);
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    return {bvhCacheKey("binned", {}, bounds, mesh.positions, mesh.triangles), buildBinned(bounds)};
}

bool same(const Bvh& a, const Bvh& b) {
    return a.nodes.size() == b.nodes.size() && a.order == b.order && a.depth == b.depth && a.skipped == b.skipped &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0;
}

std::string readAll(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void writeAll(const fs::path& path, const std::string& bytes) {
    std::ofstream stream(path, std::ios::binary);
    stream << bytes;
}

size_t fileCount(const fs::path& folder) {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Values that Appleby's MurmurHash3_x64_128 gives with seed 0.
TEST(AccelCacheHash, IsMurmurHash3) {
    const auto hash = [](std::string_view text) { return hashBytes(std::as_bytes(std::span(text))); };
    EXPECT_EQ(hash(""), (Hash128{0, 0}));
    EXPECT_EQ(hash("hello"), (Hash128{0xcbd8a7b341bd9b02u, 0x5b1e906a48ae1d19u}));
    EXPECT_EQ(hash("The quick brown fox jumps over the lazy dog"), (Hash128{0xe34bbc7bbc071b6cu, 0x7a433ca9c49a9347u}));
}

TEST_F(AccelCache, ReturnsWhatWasStored) {
    const BvhCache cache{folder_ / "not" / "there" / "yet"};
    Built built = buildSoup(2000, 81);
    built.bvh.skipped = 7;
    EXPECT_FALSE(loadCachedBvh(cache, built.key));
    storeCachedBvh(cache, built.key, built.bvh);
    const std::optional<Bvh> loaded = loadCachedBvh(cache, built.key);
    ASSERT_TRUE(loaded);
    EXPECT_TRUE(same(*loaded, built.bvh));
    EXPECT_FALSE(loadCachedBvh(cache, buildSoup(2000, 82).key));
    EXPECT_EQ(cache.hits, 1u);
    EXPECT_EQ(cache.misses, 2u);
    EXPECT_EQ(cache.rejected, 0u);
    EXPECT_EQ(cache.stored, 1u);
    EXPECT_EQ(fileCount(cache.folder), 1u) << "no temporary is left";
}

TEST_F(AccelCache, StoresTreesWithoutPrimitives) {
    const BvhCache cache{folder_};
    const BvhCacheKey key = bvhCacheKey("binned", {}, {});
    storeCachedBvh(cache, key, Bvh());
    const std::optional<Bvh> loaded = loadCachedBvh(cache, key);
    ASSERT_TRUE(loaded);
    EXPECT_TRUE(loaded->nodes.empty() && loaded->order.empty());
}

TEST(AccelCacheKey, DependsOnAllThatABuilderSees) {
    TestMesh mesh = accel_test::randomSoup(100, 0.05f, 83);
    std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    std::vector<BvhCacheKey> keys;
    const auto add = [&](const char* builder, const BvhConfig& config) {
        keys.push_back(bvhCacheKey(builder, config, bounds, mesh.positions, mesh.triangles));
    };
    add("binned", {});
    add("sweep", {});
    BvhConfig config;
    config.bins = 17;
    add("binned", config);
    config = {};
    config.intersectionCost = 1.0000001f;
    add("binned", config);
    mesh.positions[57].y = std::nextafter(mesh.positions[57].y, 10.0f);
    add("binned", {});
    std::swap(mesh.triangles[3].x, mesh.triangles[3].y);
    add("binned", {});
    bounds[99].hi.z = std::nextafter(bounds[99].hi.z, 10.0f);
    add("binned", {});
    bounds.pop_back();
    add("binned", {});
    mesh.positions.pop_back();
    add("binned", {});
    for (size_t a = 0; a < keys.size(); ++a)
        for (size_t b = 0; b < a; ++b) EXPECT_FALSE(keys[a].content == keys[b].content) << a << " and " << b;
}

TEST_F(AccelCache, RefusesTornFiles) {
    const BvhCache cache{folder_};
    const Built built = buildSoup(300, 84);
    storeCachedBvh(cache, built.key, built.bvh);
    const fs::path path = bvhCacheFile(cache, built.key);
    const std::string whole = readAll(path);
    uint32_t tries = 0;
    for (size_t size = 0; size < whole.size(); size += 1 + size / 7, ++tries) {
        writeAll(path, whole.substr(0, size));
        EXPECT_FALSE(loadCachedBvh(cache, built.key)) << size;
    }
    writeAll(path, whole + "x");
    EXPECT_FALSE(loadCachedBvh(cache, built.key));
    EXPECT_EQ(cache.rejected, tries + 1);
    writeAll(path, whole);
    EXPECT_TRUE(loadCachedBvh(cache, built.key));
}

TEST_F(AccelCache, RefusesFlippedBits) {
    const BvhCache cache{folder_};
    const Built built = buildSoup(300, 85);
    storeCachedBvh(cache, built.key, built.bvh);
    const fs::path path = bvhCacheFile(cache, built.key);
    const std::string whole = readAll(path);
    for (size_t bit = 0; bit < whole.size() * 8; bit += bit < 128 * 8 ? 1 : 997) {  // every bit of the header
        std::string flipped = whole;
        flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
        writeAll(path, flipped);
        EXPECT_FALSE(loadCachedBvh(cache, built.key)) << bit;
    }
}

TEST_F(AccelCache, RefusesAnotherKeysFileAndAFolder) {
    const BvhCache cache{folder_};
    const Built a = buildSoup(300, 86);
    const Built b = buildSoup(300, 87);
    storeCachedBvh(cache, a.key, a.bvh);
    fs::rename(bvhCacheFile(cache, a.key), bvhCacheFile(cache, b.key));
    EXPECT_FALSE(loadCachedBvh(cache, b.key));
    fs::create_directory(bvhCacheFile(cache, a.key));
    EXPECT_FALSE(loadCachedBvh(cache, a.key));
    EXPECT_EQ(cache.rejected, 2u);
}

/// Whole files with right checksums, of what is not a tree: as an older builder's mistake would leave them.
TEST_F(AccelCache, RefusesWhatIsNotATree) {
    const BvhCache cache{folder_};
    const Built built = buildSoup(300, 88);
    const auto refuses = [&](const auto& spoil) {
        Built spoilt = built;
        spoil(spoilt.bvh);
        storeCachedBvh(cache, spoilt.key, spoilt.bvh);
        return !loadCachedBvh(cache, spoilt.key);
    };
    const auto leaf = static_cast<size_t>(std::find_if(built.bvh.nodes.begin(), built.bvh.nodes.end(),
                                                       [](const BvhNode& node) { return node.isLeaf(); }) -
                                          built.bvh.nodes.begin());
    EXPECT_FALSE(refuses([](Bvh&) {}));
    EXPECT_TRUE(refuses([](Bvh& bvh) { bvh.nodes[0].left = 0; })) << "a cycle";
    EXPECT_TRUE(refuses([](Bvh& bvh) { bvh.nodes[0].left = 0xffffffffu; }));
    EXPECT_TRUE(refuses([](Bvh& bvh) { bvh.nodes[0].left = static_cast<uint32_t>(bvh.nodes.size() - 1); }));
    EXPECT_TRUE(refuses([](Bvh& bvh) { bvh.nodes[0].left = 3; })) << "nodes without a parent";
    EXPECT_TRUE(refuses([&](Bvh& bvh) { bvh.nodes[leaf].first = static_cast<uint32_t>(bvh.order.size()); }));
    EXPECT_TRUE(refuses([&](Bvh& bvh) { bvh.nodes[leaf].count = 0xffffffffu; }));
    EXPECT_TRUE(refuses([](Bvh& bvh) { bvh.order[5] = 300; }));
    EXPECT_TRUE(refuses([](Bvh& bvh) { ++bvh.depth; }));
}

TEST_F(AccelCache, ConcurrentWritersAndReadersSeeWholeTrees) {
    const BvhCache cache{folder_};
    const Built built = buildSoup(5000, 89);
    std::atomic<uint32_t> loads{0};
    const auto work = [&] {
        for (int i = 0; i < 40; ++i) {
            storeCachedBvh(cache, built.key, built.bvh);
            const std::optional<Bvh> loaded = loadCachedBvh(cache, built.key);
            loads += loaded && same(*loaded, built.bvh) ? 1 : 0;
        }
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(loads, 160u);
    EXPECT_EQ(cache.rejected, 0u);
    EXPECT_TRUE(cache.writable);
    EXPECT_EQ(fileCount(folder_), 1u);
}

TEST_F(AccelCache, RemovesTheFilesNotUsedForLongest) {
    std::array<Built, 4> built = {buildSoup(500, 90), buildSoup(500, 91), buildSoup(500, 92), buildSoup(500, 93)};
    const BvhCache unbounded{folder_};
    for (size_t i = 0; i < 3; ++i) storeCachedBvh(unbounded, built[i].key, built[i].bvh);
    uint64_t bytes = 0;
    for (size_t i = 0; i < 3; ++i) {
        const fs::path path = bvhCacheFile(unbounded, built[i].key);
        bytes += fs::file_size(path);
        fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(10 - static_cast<int>(i)));
    }
    EXPECT_TRUE(loadCachedBvh(unbounded, built[0].key)) << "the oldest is used again";
    const BvhCache bounded{folder_, bytes + bytes / 6};
    storeCachedBvh(bounded, built[3].key, built[3].bvh);
    EXPECT_TRUE(loadCachedBvh(bounded, built[0].key));
    EXPECT_FALSE(loadCachedBvh(bounded, built[1].key));
    EXPECT_TRUE(loadCachedBvh(bounded, built[2].key));
    EXPECT_TRUE(loadCachedBvh(bounded, built[3].key));
    const BvhCache tiny{folder_, 100};
    storeCachedBvh(tiny, built[1].key, built[1].bvh);
    EXPECT_EQ(tiny.stored, 0u) << "larger than the cache";
    EXPECT_EQ(fileCount(folder_), 3u);
}

TEST_F(AccelCache, AFolderThatCannotBeWrittenDisablesWriting) {
    writeAll(folder_ / "file", "not a folder");
    const Built built = buildSoup(300, 94);
    for (const fs::path& folder : {folder_ / "file" / "cache", fs::path("/proc/self")}) {  // not even by root
        const BvhCache cache{folder};
        EXPECT_FALSE(loadCachedBvh(cache, built.key));
        testing::internal::CaptureStderr();
        storeCachedBvh(cache, built.key, built.bvh);
        storeCachedBvh(cache, built.key, built.bvh);
        const std::string messages = testing::internal::GetCapturedStderr();
        EXPECT_FALSE(cache.writable);
        EXPECT_EQ(cache.stored, 0u);
        const size_t first = messages.find("not cached");
        EXPECT_NE(first, std::string::npos) << messages;
        EXPECT_EQ(messages.find("not cached", first + 1), std::string::npos) << "one warning: " << messages;
        EXPECT_FALSE(loadCachedBvh(cache, built.key));
    }
}

TEST_F(AccelCache, AReadOnlyFolderIsStillRead) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write to read-only folders";
    const Built built = buildSoup(300, 95);
    const BvhCache writer{folder_};
    storeCachedBvh(writer, built.key, built.bvh);
    fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
    const BvhCache cache{folder_};
    storeCachedBvh(cache, built.key, built.bvh);
    EXPECT_FALSE(cache.writable);
    EXPECT_TRUE(loadCachedBvh(cache, built.key));
    fs::permissions(folder_, fs::perms::owner_all);
}

TEST(AccelCacheFolder, FollowsTheEnvironment) {
    const char* const before = std::getenv("XDG_CACHE_HOME");
    const std::string saved = before != nullptr ? before : "";
    ::setenv("XDG_CACHE_HOME", "/somewhere/cache", 1);
    EXPECT_EQ(bvhCacheFolder(), fs::path("/somewhere/cache/raylab/bvh"));
    ::setenv("XDG_CACHE_HOME", "relative", 1);
    EXPECT_NE(bvhCacheFolder().string().find("/.cache/raylab/bvh"), std::string::npos);
    before != nullptr ? ::setenv("XDG_CACHE_HOME", saved.c_str(), 1) : ::unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace raylab
