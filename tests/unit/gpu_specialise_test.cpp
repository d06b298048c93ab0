#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "engine/core/error.h"
#include "engine/gpu/specialise.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/needs.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"

namespace raylab {
namespace {
namespace fs = std::filesystem;

// The SPIR-V specification, sections 2.3 and 3.42.
constexpr size_t kHeaderWords = 5;
constexpr uint32_t kOpSpecConstantTrue = 48, kOpSpecConstantOp = 52, kOpFunction = 54;

size_t countOps(const std::vector<uint32_t>& code, uint32_t first, uint32_t last) {
    size_t count = 0;
    for (size_t at = kHeaderWords; at < code.size() && code[at] >> 16 != 0; at += code[at] >> 16) {
        const uint32_t op = code[at] & 0xffffu;
        count += op >= first && op <= last ? 1 : 0;
    }
    return count;
}

class GpuSpecialise : public testing::Test {
protected:
    std::vector<uint32_t> code(uint32_t needs, const DiskCache& cache) const {
        const std::vector<SpecConstant> constants = {{shared::kSpecNeeds, needs}, {shared::kSpecStackSize, 32}};
        return specialisedCode(kernel_, constants, cache);
    }

    const support::ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path();
    const fs::path kernel_ = support::binaryFolder() / "shaders/render_bvh4b.comp.spv";
};

TEST_F(GpuSpecialise, LeavesOneFunctionWithoutConstantsToChoose) {
    const DiskCache cache{folder_};
    for (const uint32_t needs : {0u, shared::kNeedEmissive, shared::kNeedAll}) {
        const std::vector<uint32_t> result = code(needs, cache);
        ASSERT_GT(result.size(), kHeaderWords);
        EXPECT_EQ(countOps(result, kOpSpecConstantTrue, kOpSpecConstantOp), 0u);
        EXPECT_EQ(countOps(result, kOpFunction, kOpFunction), 1u);
    }
}

TEST_F(GpuSpecialise, HoldsNoMoreThanIsNeeded) {
    const DiskCache cache{folder_};
    const size_t none = code(0, cache).size(), all = code(shared::kNeedAll, cache).size();
    EXPECT_LT(code(shared::kNeedEmissive, cache).size(), all);
    EXPECT_LT(none * 3, all * 2) << "textures, lights and lobes are at least a third of a kernel that has them";
}

TEST_F(GpuSpecialise, TakesFromTheCacheWhatItMade) {
    const DiskCache cache{folder_};
    const std::vector<uint32_t> made = code(0, cache);
    EXPECT_EQ(cache.stored, 1u);
    EXPECT_EQ(code(0, cache), made);
    EXPECT_EQ(cache.hits, 1u);
    EXPECT_NE(code(shared::kNeedEmissive, cache), made);
    EXPECT_EQ(cache.stored, 2u);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) std::ofstream(entry.path()) << "torn";
    EXPECT_EQ(code(0, cache), made);
    EXPECT_EQ(cache.rejected, 1u);
    const DiskCache none;
    EXPECT_EQ(code(0, none), made);
}

TEST_F(GpuSpecialise, RefusesWhatIsNotSpirv) {
    const DiskCache cache{folder_};
    const fs::path path = folder_ / "text.spv";
    std::ofstream(path) << "not SPIR-V, but a whole number of words.";
    try {
        specialisedCode(path, {}, cache);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("text.spv"), std::string::npos) << error.what();
    }
    EXPECT_THROW(specialisedCode(folder_ / "none.spv", {}, cache), Error);
}

}  // namespace
}  // namespace raylab
