#include <gtest/gtest.h>

#include "engine/measure/memory_bench.h"
#include "engine/measure/ray_bench.h"

namespace raylab {
namespace {

TEST(MemoryBench, RatesAreThoseOfAMachine) {
    const MemoryBandwidth memory = measureHostMemory(
        {.copyBytes = size_t{4} << 20, .largeBytes = size_t{4} << 20, .smallBytes = 4096, .loads = size_t{1} << 18});
    for (const double rate : {memory.copy, memory.gatherLarge, memory.gatherSmall}) {
        EXPECT_GT(rate, 1e6);
        EXPECT_LT(rate, 1e14);
    }
}

TEST(MemoryBench, BytesOfARayByHand) {
    const RayCounters counters{.nodes = 10.0, .triangles = 2.5, .instances = 1.0};
    EXPECT_DOUBLE_EQ(bytesPerRay({"software", "bvh2", "watertight", "binned", ""}, counters), 640.0 + 120.0 + 96.0);
    EXPECT_DOUBLE_EQ(bytesPerRay({"software", "bvh8q", "precomputed", "binned", ""}, counters), 800.0 + 160.0 + 96.0);
    EXPECT_ANY_THROW(bytesPerRay({"embree1", "", "", "", ""}, counters));
}

}  // namespace
}  // namespace raylab
