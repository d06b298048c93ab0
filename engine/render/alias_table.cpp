#include "engine/render/alias_table.h"

#include <numeric>

namespace raylab {

std::vector<AliasEntry> buildAliasTable(std::span<const double> weights) {
    const size_t n = weights.size();
    std::vector<AliasEntry> table(n);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<double> scaled(n, 1.0);
    if (total > 0.0)
        for (size_t i = 0; i < n; ++i) scaled[i] = weights[i] / total * static_cast<double>(n);
    std::vector<uint32_t> small, large;
    for (size_t i = 0; i < n; ++i) (scaled[i] < 1.0 ? small : large).push_back(static_cast<uint32_t>(i));
    while (!small.empty() && !large.empty()) {
        const uint32_t under = small.back(), over = large.back();
        small.pop_back();
        table[under] = {static_cast<float>(scaled[under]), over};
        scaled[over] -= 1.0 - scaled[under];
        if (scaled[over] < 1.0) {
            large.pop_back();
            small.push_back(over);
        }
    }
    // What is left differs from 1 by rounding alone.
    for (const uint32_t i : small) table[i] = {1.0f, i};
    for (const uint32_t i : large) table[i] = {1.0f, i};
    return table;
}

}  // namespace raylab
