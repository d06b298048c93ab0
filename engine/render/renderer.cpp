#include "engine/render/renderer.h"

#include <algorithm>

#include "engine/core/stopwatch.h"
#include "engine/render/render_constants.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

/// The smallest piece of work is a block of lanes of one tile. The first dispatch is small, and the next at most so
/// many times as large: an estimate from cheap tiles (sky) must not send a dispatch of costly ones that holds the
/// device for long.
constexpr uint32_t kBlockLanes = 8;
constexpr uint32_t kBlocksPerTile = shared::kWorkgroupSize / kBlockLanes;
constexpr uint32_t kFirstBlockCount = 1;
constexpr uint32_t kGrowth = 2;
constexpr uint32_t kMostSamplesAtOnce = 64;
constexpr double kMemory = 0.8;

constexpr BindingInfo kFilmBinding{shared::kBindFilm, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC};

KernelLayout makeLayout(const Device& device, const PreparedScene& prepared) {
    std::vector<BindingInfo> bindings = sceneBindings(prepared);
    bindings.push_back(kFilmBinding);
    return KernelLayout(device, bindings, sizeof(shared::RenderPush), prepared.tracer->stages());
}

}  // namespace

Renderer::Renderer(Device& device, const Scene& scene, const RenderSettings& settings)
    : device_(device),
      settings_(settings),
      prepared_(prepareScene(device, scene, settings)),
      frame_(makeFrame(prepared_, settings)),
      film_(device, frame_.width, frame_.height) {
    Stopwatch watch;
    frameBuffer_ =
        makeDeviceBuffer(device, "frame", std::as_bytes(std::span(&frame_, 1)), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    layout_ = makeLayout(device, prepared_);
    bindScene(device, prepared_, layout_);
    bindBuffer(device, layout_, {shared::kBindFrame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}, frameBuffer_.get(), 0,
               frameBuffer_.sizeBytes());
    bindBuffer(device, layout_, kFilmBinding, film_.buffer(), 0, film_.bandBytes());
    times_.build = prepared_.tracer->buildSeconds();
    times_.upload = prepared_.tracer->uploadSeconds() + prepared_.packSeconds + watch.restart();
    kernel_ = makeSceneKernel(device, prepared_, layout_, KernelKind::render, renderConstants(settings));
    const uint32_t tileRows = (frame_.height + shared::kTileSize - 1) / shared::kTileSize;
    blockCount_ = frame_.tilesPerRow * tileRows * kBlocksPerTile;
    dispatch(0, 1, 0, 0);  // lavapipe compiles at the first dispatch
    times_.compile = watch.restart();
    times_.device = 0.0;
    times_.longestDispatch = 0.0;
}

/// Blocks within one tile, or whole tiles.
double Renderer::dispatch(uint32_t firstBlock, uint32_t blockCount, uint32_t firstSample, uint32_t sampleCount) {
    const uint32_t firstTile = firstBlock / kBlocksPerTile;
    const uint32_t tileCount = (blockCount + kBlocksPerTile - 1) / kBlocksPerTile;
    const uint32_t lanes = std::min(blockCount, kBlocksPerTile) * kBlockLanes;
    const uint32_t band = firstTile / frame_.tilesPerRow * shared::kTileSize / film_.rowsPerBand();
    const shared::RenderPush push{
        firstTile, band * film_.rowsPerBand(), firstSample, sampleCount, firstBlock % kBlocksPerTile * kBlockLanes,
        lanes};
    const auto offset = static_cast<uint32_t>(band * film_.bandBytes());
    const double seconds = device_.run("render", [&](VkCommandBuffer commands) {
        launch(device_, commands, layout_, kernel_, std::span(&offset, 1), &push, tileCount);
    });
    times_.device += seconds;
    times_.longestDispatch = std::max(times_.longestDispatch, seconds);
    return seconds;
}

/// Blocks of the next dispatch: within the pass, within the film band, and about as many as a slice holds.
uint32_t Renderer::chooseBlockCount() const {
    const uint32_t blocksPerBand = film_.rowsPerBand() / shared::kTileSize * frame_.tilesPerRow * kBlocksPerTile;
    const uint32_t bandEnd = std::min((nextBlock_ / blocksPerBand + 1) * blocksPerBand, blockCount_);
    uint32_t count = kFirstBlockCount;
    if (lastBlockCount_ > 0) {
        const double perBlock = std::max(secondsPerBlockSample_ * passSamples_, 1e-9);
        const double fitting = std::clamp(settings_.sliceMs * 1e-3 / perBlock, 1.0, 1e9);
        count = std::min(static_cast<uint32_t>(fitting), lastBlockCount_ * kGrowth);
    }
    const uint32_t inTile = nextBlock_ % kBlocksPerTile;
    if (inTile != 0 || count < kBlocksPerTile) return std::min(count, kBlocksPerTile - inTile);
    return std::min(count / kBlocksPerTile * kBlocksPerTile, bandEnd - nextBlock_);
}

/// Samples of the next pass: several where the whole image takes less than a slice.
void Renderer::chooseSampleCount() {
    const double perSample = passSeconds_ / passSamples_;
    const double fitting =
        std::clamp(settings_.sliceMs * 1e-3 / std::max(perSample, 1e-9), 1.0, double{kMostSamplesAtOnce});
    const auto remaining = static_cast<uint32_t>(settings_.spp - passFirst_);
    passSamples_ = std::min({static_cast<uint32_t>(fitting), passSamples_ * kGrowth, std::max(remaining, 1u)});
    passSeconds_ = 0.0;
}

bool Renderer::step() {
    if (passFirst_ >= static_cast<uint64_t>(settings_.spp)) return false;
    const uint32_t count = chooseBlockCount();
    Stopwatch watch;
    const double seconds = dispatch(nextBlock_, count, passFirst_, passSamples_);
    times_.render += watch.seconds();
    passSeconds_ += seconds;
    // Costly blocks are remembered for a while, lest cheap ones (sky) before them lead to a dispatch that is far too
    // long.
    secondsPerBlockSample_ =
        std::max(seconds / (static_cast<double>(count) * passSamples_), kMemory * secondsPerBlockSample_);
    lastBlockCount_ = count;
    pixelSamples_ += uint64_t{count} * kBlockLanes * passSamples_;
    nextBlock_ += count;
    if (nextBlock_ == blockCount_) {
        nextBlock_ = 0;
        passFirst_ += passSamples_;
        chooseSampleCount();
    }
    return passFirst_ < static_cast<uint64_t>(settings_.spp);
}

double Renderer::fractionDone() const {
    const double inPass = static_cast<double>(nextBlock_) / blockCount_ * passSamples_;
    return (passFirst_ + inPass) / static_cast<double>(settings_.spp);
}

}  // namespace raylab
