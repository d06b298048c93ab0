#include "engine/render/adaptive.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/luminance.h"

namespace raylab {
namespace {

constexpr int kBlockWidth = 4;
constexpr int kBlockHeight = 2;
constexpr int kTile = static_cast<int>(shared::kTileSize);
constexpr int kSearchSteps = 60;

/// Blocks in rows, with the relative variance of one sample and the pixels that each has within the image.
struct BlockGrid {
    int width = 0;
    int height = 0;
    std::vector<double> variance;
    std::vector<double> pixels;
};

/// Relative variance of a pixel's sample; the deviations of the channels are taken to go together, as developFilm()
/// does.
double relativeVariance(const FilmImage& pilot, int x, int y) {
    const float* v = pilot.variance.at(x, y);
    const float deviation[3] = {std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2])};
    const double mean = luminance(pilot.mean.at(x, y)), sigma = luminance(deviation);
    return sigma * sigma / (mean * mean + kRelativeErrorFloor);
}

/// Means over the blocks' pixels.
BlockGrid measureBlocks(const FilmImage& pilot) {
    const int tilesX = (pilot.mean.width + kTile - 1) / kTile, tilesY = (pilot.mean.height + kTile - 1) / kTile;
    BlockGrid grid{tilesX * (kTile / kBlockWidth), tilesY * (kTile / kBlockHeight), {}, {}};
    const auto count = static_cast<size_t>(grid.width) * static_cast<size_t>(grid.height);
    grid.variance.resize(count);
    grid.pixels.resize(count);
    for (int y = 0; y < pilot.mean.height; ++y)
        for (int x = 0; x < pilot.mean.width; ++x) {
            const auto at = static_cast<size_t>(y / kBlockHeight * grid.width + x / kBlockWidth);
            grid.variance[at] += relativeVariance(pilot, x, y);
            grid.pixels[at] += 1.0;
        }
    return grid;
}

/// Mean variance of a block's pixels and of its neighbours'.
std::vector<double> smoothed(const BlockGrid& grid) {
    std::vector<double> result(grid.variance.size());
    for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x) {
            double sum = 0.0, pixels = 0.0;
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, grid.height - 1); ++j)
                for (int i = std::max(x - 1, 0); i <= std::min(x + 1, grid.width - 1); ++i) {
                    sum += grid.variance[static_cast<size_t>(j * grid.width + i)];
                    pixels += grid.pixels[static_cast<size_t>(j * grid.width + i)];
                }
            result[static_cast<size_t>(y * grid.width + x)] = pixels > 0.0 ? sum / pixels : 0.0;
        }
    return result;
}

double meanRate(const std::vector<double>& rates, const BlockGrid& grid) {
    return std::inner_product(rates.begin(), rates.end(), grid.pixels.begin(), 0.0) /
           std::accumulate(grid.pixels.begin(), grid.pixels.end(), 0.0);
}

std::vector<double> clamped(const std::vector<double>& wishes, double scale, const AdaptiveConfig& config) {
    std::vector<double> rates;
    for (const double wish : wishes) rates.push_back(std::clamp(wish * scale, config.leastRate, config.mostRate));
    return rates;
}

/// The wishes, scaled by bisection so that the clamped rates' mean is 1.
std::vector<double> normalised(const std::vector<double>& wishes, const BlockGrid& grid, const AdaptiveConfig& config) {
    double low = 1e-12, high = 1e12;
    for (int i = 0; i < kSearchSteps; ++i) {
        const double middle = std::sqrt(low * high);
        (meanRate(clamped(wishes, middle, config), grid) < 1.0 ? low : high) = middle;
    }
    return clamped(wishes, std::sqrt(low * high), config);
}

/// From rows of blocks to blocks by tiles.
std::vector<float> byTile(const std::vector<double>& rates, const BlockGrid& grid) {
    std::vector<float> result;
    for (int tileY = 0; tileY < grid.height; tileY += kTile / kBlockHeight)
        for (int tileX = 0; tileX < grid.width; tileX += kTile / kBlockWidth)
            for (int y = tileY; y < tileY + kTile / kBlockHeight; ++y)
                for (int x = tileX; x < tileX + kTile / kBlockWidth; ++x)
                    result.push_back(static_cast<float>(rates[static_cast<size_t>(y * grid.width + x)]));
    return result;
}

}  // namespace

std::vector<float> sampleRates(const FilmImage& pilot, const AdaptiveConfig& config) {
    const BlockGrid grid = measureBlocks(pilot);
    const std::vector<double> variance = smoothed(grid);
    if (std::all_of(variance.begin(), variance.end(), [](double v) { return v <= 0.0; }))
        return std::vector<float>(variance.size(), 1.0f);
    if (config.targetError > 0.0) {
        const double perSample = 1.0 / (config.targetError * config.targetError * config.samples);
        const std::vector<double> rates = clamped(variance, perSample, config);
        if (meanRate(rates, grid) <= 1.0) return byTile(rates, grid);
    }
    std::vector<double> deviation;
    for (const double v : variance) deviation.push_back(std::sqrt(v));
    return byTile(normalised(deviation, grid, config), grid);
}

}  // namespace raylab
