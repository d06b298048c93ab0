#include "engine/accel/build_morton.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace raylab {
namespace {

constexpr int kBits = 10;  // an axis
constexpr int kDigits = 1 << kBits;
constexpr size_t kRun = 32;  // that many in a cell stay in the order that they are in

/// The code in the upper half, the index in the lower one: no two are equal.
using Key = uint64_t;

uint32_t codeOf(Key key) { return static_cast<uint32_t>(key >> 32); }
uint32_t indexOf(Key key) { return static_cast<uint32_t>(key); }

/// Two zero bits between each of the lower ten.
Int4 spread(Int4 x) {
    x = (x | (x << 16)) & 0x030000ff;
    x = (x | (x << 8)) & 0x0300f00f;
    x = (x | (x << 4)) & 0x030c30c3;
    return (x | (x << 2)) & 0x09249249;
}

/// Cells of a cube that begins at the lower corner of a box; scale 0 where the box is a point.
struct MortonGrid {
    Float4 base;
    Float4 scale = splat(0.0f);

    explicit MortonGrid(const Box4& box) : base(box.lo) {
        const int axis = longestAxis(box);
        // As in BinMapping: the last one stays in the last cell.
        const float reach = static_cast<float>(kDigits) * 0.99999f / (box.hi[axis] - box.lo[axis]);
        if (std::isfinite(reach)) scale = splat(reach);
    }
    bool isPoint() const { return scale[0] == 0.0f; }
    Key key(const PrimitiveRef& ref, uint32_t index) const {
        const Int4 cell = spread(truncate((ref.centroid2() - base) * scale));
        const auto code = static_cast<uint32_t>(cell[0] << 2 | cell[1] << 1 | cell[2]);
        return Key{code} << 32 | index;
    }
};

/// By one digit of the code, stable, into `target`.
void sortByDigit(std::span<const Key> keys, int shift, std::span<Key> target) {
    const auto digit = [shift](Key key) { return key >> shift & (kDigits - 1); };
    std::vector<std::array<size_t, kDigits>> starts(chunkCount(keys.size()));
    forEachChunk(keys.size(), [&](size_t chunk, size_t begin, size_t end) {
        starts[chunk].fill(0);
        for (const Key key : keys.subspan(begin, end - begin)) ++starts[chunk][digit(key)];
    });
    size_t next = 0;
    for (size_t value = 0; value < kDigits; ++value)
        for (std::array<size_t, kDigits>& start : starts) next += std::exchange(start[value], next);
    forEachChunk(keys.size(), [&](size_t chunk, size_t begin, size_t end) {
        std::array<size_t, kDigits>& start = starts[chunk];
        for (const Key key : keys.subspan(begin, end - begin)) target[start[digit(key)]++] = key;
    });
}

/// Indices come in ascending order, so that a stable sort by code alone is a sort of the keys.
void sortKeys(std::span<Key> keys) {
    if (keys.size() <= kChunk) {
        std::sort(keys.begin(), keys.end());
        return;
    }
    std::vector<Key> spare(keys.size());
    sortByDigit(keys, 32, spare);
    sortByDigit(spare, 32 + kBits, keys);
    sortByDigit(keys, 32 + 2 * kBits, spare);
    std::copy(spare.begin(), spare.end(), keys.begin());
}

/// The stretches of more than kRun keys of one code.
std::vector<std::span<Key>> longRuns(std::span<Key> keys) {
    std::vector<std::vector<std::span<Key>>> ofChunks(chunkCount(keys.size()));
    const auto endOfRun = [&](size_t begin) {
        size_t end = begin + 1;
        while (end < keys.size() && codeOf(keys[end]) == codeOf(keys[begin])) ++end;
        return end;
    };
    forEachChunk(keys.size(), [&](size_t chunk, size_t begin, size_t end) {
        if (begin > 0 && codeOf(keys[begin - 1]) == codeOf(keys[begin])) begin = endOfRun(begin);
        while (begin < end) {
            const size_t next = endOfRun(begin);
            if (next - begin > kRun) ofChunks[chunk].push_back(keys.subspan(begin, next - begin));
            begin = next;
        }
    });
    std::vector<std::span<Key>> runs;
    for (const std::vector<std::span<Key>>& some : ofChunks) runs.insert(runs.end(), some.begin(), some.end());
    return runs;
}

/// A run's box is that of one cell, so the recursion ends where floats do.
void sortAlongCurve(std::span<const PrimitiveRef> refs, const Box4& centroids2, std::span<Key> keys) {
    const MortonGrid grid(centroids2);
    if (grid.isPoint()) return;
    forEachChunk(keys.size(), [&](size_t, size_t begin, size_t end) {
        for (Key& key : keys.subspan(begin, end - begin)) key = grid.key(refs[indexOf(key)], indexOf(key));
    });
    sortKeys(keys);
    const std::vector<std::span<Key>> runs = longRuns(keys);
    if (runs.empty()) return;
    parallelFor(runs.size(), [&](size_t i) {
        Box4 box;
        for (const Key key : runs[i]) box.grow(refs[indexOf(key)].centroid2(), refs[indexOf(key)].centroid2());
        sortAlongCurve(refs, box, runs[i]);
    });
}

}  // namespace

std::vector<uint32_t> mortonOrder(std::span<const PrimitiveRef> refs, const Box4& centroids2) {
    std::vector<Key> keys(refs.size());
    for (size_t i = 0; i < keys.size(); ++i) keys[i] = i;
    sortAlongCurve(refs, centroids2, keys);
    std::vector<uint32_t> order(refs.size());
    std::transform(keys.begin(), keys.end(), order.begin(), indexOf);
    return order;
}

}  // namespace raylab
