#include "engine/render/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/error.h"
#include "engine/render/blue_noise.h"

namespace raylab {
namespace {

constexpr std::array<std::string_view, 4> kSamplers = {"sobol", "independent", "stratified", "blue-noise"};

struct FilterInfo {
    std::string_view name;
    float usualRadius;  ///< pixels
};

constexpr std::array kFilters = {FilterInfo{"box", 0.5f}, FilterInfo{"tent", 1.0f}, FilterInfo{"blackman-harris", 1.5f},
                                 FilterInfo{"gaussian", 1.5f}};

/// The kernel divides sample numbers in floats, which are exact up to here.
constexpr int64_t kMostStratified = int64_t{1} << 24;

static_assert(uint32_t{1} << shared::kBlueNoiseRankBits == shared::kBlueNoiseSize * shared::kBlueNoiseSize);

/// Always the same, and 20 ms of work: made once for all films of the process.
std::span<const uint32_t> blueNoise() {
    static const std::vector<uint32_t> ranks = makeBlueNoise(shared::kBlueNoiseSize);
    return ranks;
}

}  // namespace

std::vector<std::string> samplerNames() { return {kSamplers.begin(), kSamplers.end()}; }

std::vector<std::string> filterNames() {
    std::vector<std::string> names;
    for (const FilterInfo& filter : kFilters) names.emplace_back(filter.name);
    return names;
}

void writeSampling(const RenderSettings& settings, shared::FrameParams& frame) {
    if (settings.sampler == kSamplers[shared::kSamplerStratified] && settings.spp > kMostStratified)
        throw Error("--sampler stratified takes --spp " + std::to_string(kMostStratified) +
                    " at most; the sobol sampler takes more");
    frame.sampleCount = static_cast<uint32_t>(settings.spp);
    frame.strataWidth = static_cast<uint32_t>(std::sqrt(static_cast<double>(settings.spp)));
    const auto filter = std::ranges::find(kFilters, settings.filter, &FilterInfo::name);
    if (filter == kFilters.end()) throw Error("--filter: there is no filter '" + settings.filter + "'");
    frame.filterRadius = settings.filterRadius > 0.0 ? static_cast<float>(settings.filterRadius) : filter->usualRadius;
    frame.clampRadiance = static_cast<float>(settings.clamp);
}

TexelBuffer makeSamplerMask(Device& device, const RenderSettings& settings) {
    std::span<const uint32_t> ranks;
    if (settings.sampler == kSamplers[shared::kSamplerBlueNoise]) ranks = blueNoise();
    return makeTexelBuffer(device, "blue noise", std::as_bytes(ranks), VK_FORMAT_R32_UINT, 4);
}

}  // namespace raylab
