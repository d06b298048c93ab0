#include "engine/measure/memory_bench.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/stopwatch.h"

namespace raylab {
namespace {

struct Word {
    uint64_t low = 1;
    uint64_t high = 1;
};
static_assert(sizeof(Word) == 16);

template <class Work>
double fastestSeconds(int repeats, const Work& work) {
    work();
    double fastest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repeats; ++i) {
        const Stopwatch watch;
        work();
        fastest = std::min(fastest, watch.seconds());
    }
    return fastest;
}

double measureCopy(const MemoryBenchConfig& config) {
    const std::vector<std::byte> source(config.copyBytes, std::byte{1});
    std::vector<std::byte> target(config.copyBytes);
    const double seconds = fastestSeconds(config.repeats, [&] {
        tbb::parallel_for(tbb::blocked_range<size_t>(0, source.size(), size_t{1} << 20), [&](const auto& range) {
            std::memcpy(&target[range.begin()], &source[range.begin()], range.size());
        });
    });
    return static_cast<double>(config.copyBytes) / seconds;
}

/// Each address is computed, not loaded (a multiplicative hash of the load's number), so that loads may overlap.
uint64_t sumOfRandomLoads(const std::vector<Word>& table, size_t loads) {
    const int shift = 64 - std::countr_zero(table.size());
    return tbb::parallel_reduce(
        tbb::blocked_range<size_t>(0, loads, size_t{1} << 16), uint64_t{0},
        [&](const auto& range, uint64_t sum) {
            for (size_t i = range.begin(); i != range.end(); ++i) {
                const uint64_t hash = (i ^ (i << 32)) * 0x9e3779b97f4a7c15u;
                const Word& word = table[hash >> shift];
                sum += word.low + word.high;
            }
            return sum;
        },
        std::plus<>());
}

double measureGather(size_t tableBytes, const MemoryBenchConfig& config) {
    const std::vector<Word> table(std::bit_floor(std::max<size_t>(tableBytes / sizeof(Word), 2)));
    uint64_t sum = 0;
    const double seconds = fastestSeconds(config.repeats, [&] { sum = sumOfRandomLoads(table, config.loads); });
    if (sum != 2 * config.loads)
        throw Error("the memory benchmark read what it did not write", ExitCode::internalError);
    return static_cast<double>(config.loads * sizeof(Word)) / seconds;
}

}  // namespace

MemoryBandwidth measureHostMemory(const MemoryBenchConfig& config) {
    return {measureCopy(config), measureGather(config.largeBytes, config), measureGather(config.smallBytes, config)};
}

}  // namespace raylab
