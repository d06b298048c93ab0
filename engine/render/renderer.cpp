#include "engine/render/renderer.h"

#include <algorithm>

#include "engine/core/stopwatch.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

/// The first dispatch is small, and the next at most so many times as large: an estimate from cheap tiles (sky) must not
/// send a dispatch of costly ones that holds the device for long.
constexpr uint32_t kFirstTileCount = 2;
constexpr uint32_t kGrowth = 2;
constexpr uint32_t kMostSamplesAtOnce = 64;
constexpr double kMemory = 0.8;

constexpr BindingInfo kFilmBinding{shared::kBindFilm, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC};

KernelLayout makeLayout(const Device& device, const PreparedScene& prepared) {
    std::vector<BindingInfo> bindings = sceneBindings(prepared);
    bindings.push_back(kFilmBinding);
    return KernelLayout(device, bindings, sizeof(shared::RenderPush));
}

}  // namespace

Renderer::Renderer(Device& device, const Scene& scene, const RenderSettings& settings)
    : device_(device), settings_(settings), prepared_(prepareScene(device, scene, settings)),
      frame_(makeFrame(prepared_, settings)), film_(device, frame_.width, frame_.height) {
    Stopwatch watch;
    frameBuffer_ = makeDeviceBuffer(device, "frame", std::as_bytes(std::span(&frame_, 1)), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    layout_ = makeLayout(device, prepared_);
    bindScene(device, prepared_, layout_);
    bindBuffer(device, layout_, {shared::kBindFrame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}, frameBuffer_.get(), 0,
               frameBuffer_.sizeBytes());
    bindBuffer(device, layout_, kFilmBinding, film_.buffer(), 0, film_.bandBytes());
    times_.build = prepared_.tracer->buildSeconds();
    times_.upload = prepared_.tracer->uploadSeconds() + prepared_.packSeconds + watch.restart();
    pipeline_ = makeSceneKernel(device, prepared_, layout_, prepared_.tracer->info().renderKernel,
                                findIntegrator(settings.integrator).id);
    tileCount_ = frame_.tilesPerRow * ((frame_.height + shared::kTileSize - 1) / shared::kTileSize);
    dispatch(0, 1, 0, 0);  // lavapipe compiles at the first dispatch
    times_.compile = watch.restart();
    times_.device = 0.0;
    times_.longestDispatch = 0.0;
}

double Renderer::dispatch(uint32_t firstTile, uint32_t tileCount, uint32_t firstSample, uint32_t sampleCount) {
    const uint32_t band = firstTile / frame_.tilesPerRow * shared::kTileSize / film_.rowsPerBand();
    const shared::RenderPush push{firstTile, band * film_.rowsPerBand(), firstSample, sampleCount};
    const auto offset = static_cast<uint32_t>(band * film_.bandBytes());
    const double seconds = device_.run("render", [&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.pipelineLayout.get(), 0, 1, &layout_.set,
                                1, &offset);
        vkCmdPushConstants(commands, layout_.pipelineLayout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
        vkCmdDispatch(commands, tileCount, 1, 1);
    });
    times_.device += seconds;
    times_.longestDispatch = std::max(times_.longestDispatch, seconds);
    return seconds;
}

/// Tiles of the next dispatch: within the pass, within the film band, and about as many as a slice holds.
uint32_t Renderer::chooseTileCount() const {
    const uint32_t tilesPerBand = film_.rowsPerBand() / shared::kTileSize * frame_.tilesPerRow;
    const uint32_t bandEnd = std::min((nextTile_ / tilesPerBand + 1) * tilesPerBand, tileCount_);
    uint32_t count = kFirstTileCount;
    if (lastTileCount_ > 0) {
        const double perTile = std::max(secondsPerTileSample_ * passSamples_, 1e-9);
        const double fitting = std::clamp(settings_.sliceMs * 1e-3 / perTile, 1.0, 1e9);
        count = std::min(static_cast<uint32_t>(fitting), lastTileCount_ * kGrowth);
    }
    return std::min(count, bandEnd - nextTile_);
}

/// Samples of the next pass: several where the whole image takes less than a slice.
void Renderer::chooseSampleCount() {
    const double perSample = passSeconds_ / passSamples_;
    const double fitting = std::clamp(settings_.sliceMs * 1e-3 / std::max(perSample, 1e-9), 1.0, double{kMostSamplesAtOnce});
    const auto remaining = static_cast<uint32_t>(settings_.spp - passFirst_);
    passSamples_ = std::min({static_cast<uint32_t>(fitting), passSamples_ * kGrowth, std::max(remaining, 1u)});
    passSeconds_ = 0.0;
}

bool Renderer::step() {
    if (passFirst_ >= static_cast<uint64_t>(settings_.spp)) return false;
    const uint32_t count = chooseTileCount();
    Stopwatch watch;
    const double seconds = dispatch(nextTile_, count, passFirst_, passSamples_);
    times_.render += watch.seconds();
    passSeconds_ += seconds;
    // Costly tiles are remembered for a while, lest cheap ones (sky) before them lead to a dispatch that is far too long.
    secondsPerTileSample_ = std::max(seconds / (static_cast<double>(count) * passSamples_), kMemory * secondsPerTileSample_);
    lastTileCount_ = count;
    pixelSamples_ += uint64_t{count} * shared::kWorkgroupSize * passSamples_;
    nextTile_ += count;
    if (nextTile_ == tileCount_) {
        nextTile_ = 0;
        passFirst_ += passSamples_;
        chooseSampleCount();
    }
    return passFirst_ < static_cast<uint64_t>(settings_.spp);
}

double Renderer::fractionDone() const {
    const double inPass = static_cast<double>(nextTile_) / tileCount_ * passSamples_;
    return (passFirst_ + inPass) / static_cast<double>(settings_.spp);
}

}  // namespace raylab
