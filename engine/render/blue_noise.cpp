#include "engine/render/blue_noise.h"

#include <algorithm>
#include <cmath>

namespace raylab {
namespace {

/// Ulichney's choice, in pixels.
constexpr double kSigma = 1.5;
/// Part of the pixels that the first pattern has.
constexpr uint32_t kFirstShare = 10;

/// A set of pixels on a torus, and at each pixel the sum of Gaussians around the pixels of the set.
class Pattern {
public:
    explicit Pattern(uint32_t size) : size_(size), kernel_(size * size), energy_(size * size), in_(size * size) {
        for (uint32_t y = 0; y < size; ++y)
            for (uint32_t x = 0; x < size; ++x) {
                const double dx = std::min(x, size - x), dy = std::min(y, size - y);
                kernel_[y * size + x] = std::exp(-(dx * dx + dy * dy) / (2.0 * kSigma * kSigma));
            }
    }

    bool contains(uint32_t pixel) const { return in_[pixel]; }
    void add(uint32_t pixel) { set(pixel, true); }
    void remove(uint32_t pixel) { set(pixel, false); }

    /// The pixel of the set that has the most others around it.
    uint32_t tightestCluster() const { return extreme(true, 1.0); }
    /// The pixel outside that has the fewest around it.
    uint32_t largestVoid() const { return extreme(false, -1.0); }

private:
    void set(uint32_t pixel, bool in) {
        in_[pixel] = in;
        const uint32_t px = pixel % size_, py = pixel / size_;
        for (uint32_t y = 0; y < size_; ++y) {
            const double* const row = &kernel_[(y >= py ? y - py : y + size_ - py) * size_];
            for (uint32_t x = 0; x < size_; ++x) {
                const double value = row[x >= px ? x - px : x + size_ - px];
                energy_[y * size_ + x] += in ? value : -value;
            }
        }
    }

    uint32_t extreme(bool in, double sign) const {
        uint32_t best = 0;
        double most = -1e30;
        for (uint32_t i = 0; i < in_.size(); ++i)
            if (in_[i] == in && sign * energy_[i] > most) {
                most = sign * energy_[i];
                best = i;
            }
        return best;
    }

    uint32_t size_;
    std::vector<double> kernel_;
    std::vector<double> energy_;
    std::vector<bool> in_;
};

/// Few points, first anywhere, then moved from the tightest cluster to the largest void until none moves.
Pattern firstPattern(uint32_t size, uint32_t points) {
    Pattern pattern(size);
    uint64_t state = 1;
    for (uint32_t placed = 0; placed < points;) {
        state = state * 6364136223846793005u + 1442695040888963407u;  // Knuth, MMIX
        const auto pixel = static_cast<uint32_t>(state >> 33) % (size * size);
        if (pattern.contains(pixel)) continue;
        pattern.add(pixel);
        ++placed;
    }
    for (;;) {
        const uint32_t from = pattern.tightestCluster();
        pattern.remove(from);
        const uint32_t to = pattern.largestVoid();
        pattern.add(to);
        if (to == from) return pattern;
    }
}

}  // namespace

std::vector<uint32_t> makeBlueNoise(uint32_t size) {
    const uint32_t first = size * size / kFirstShare;
    std::vector<uint32_t> ranks(size_t{size} * size);
    const Pattern start = firstPattern(size, first);
    Pattern pattern = start;
    for (uint32_t rank = first; rank-- > 0;) {
        const uint32_t pixel = pattern.tightestCluster();
        pattern.remove(pixel);
        ranks[pixel] = rank;
    }
    pattern = start;
    for (uint32_t rank = first; rank < ranks.size(); ++rank) {
        const uint32_t pixel = pattern.largestVoid();
        pattern.add(pixel);
        ranks[pixel] = rank;
    }
    return ranks;
}

}  // namespace raylab
