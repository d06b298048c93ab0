#include "engine/measure/path_counts.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace raylab {

std::vector<BounceCounts> countPaths(RayCaster& caster, const Scene& scene, const BenchView& view, int bounces) {
    std::vector<BounceCounts> result;
    for (PixelRays& path : makePathRays(caster, scene, view, bounces))
        result.push_back({std::move(path.pixels), caster.count(path.rays, false).counts});
    return result;
}

CountSummary summarise(const BounceCounts& bounce, const CountField& field) {
    CountSummary summary;
    if (bounce.counts.empty()) return summary;
    std::vector<uint32_t> values;
    for (const shared::RayCounts& counts : bounce.counts) values.push_back(counts.*field.member);
    std::ranges::sort(values);
    double sum = 0.0;
    for (const uint32_t value : values) {
        sum += value;
        const size_t bin = static_cast<size_t>(std::bit_width(value));
        if (summary.histogram.size() <= bin) summary.histogram.resize(bin + 1, 0);
        ++summary.histogram[bin];
    }
    summary.mean = sum / static_cast<double>(values.size());
    summary.median = values[(values.size() - 1) / 2];
    summary.high = values[(values.size() - 1) * 99 / 100];
    summary.most = values.back();
    return summary;
}

Bitmap countMap(const BounceCounts& bounce, const CountField& field, uint32_t width, uint32_t height) {
    Bitmap map(static_cast<int>(width), static_cast<int>(height), 1);
    std::ranges::fill(map.pixels, std::numeric_limits<float>::quiet_NaN());
    for (size_t i = 0; i < bounce.counts.size(); ++i)
        map.pixels[bounce.pixels[i]] = static_cast<float>(bounce.counts[i].*field.member);
    return map;
}

}  // namespace raylab
