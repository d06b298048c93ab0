#include "engine/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/render/adaptive.h"
#include "engine/render/render_constants.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

/// The smallest piece of work is a block of lanes of one tile. The first dispatch is small, and the next at most so
/// many times as large: an estimate from cheap tiles (sky) must not send a dispatch of costly ones that holds the
/// device for long.
constexpr uint32_t kBlockLanes = shared::kLanesPerBlock;
constexpr uint32_t kBlocksPerTile = shared::kWorkgroupSize / kBlockLanes;
constexpr uint32_t kFirstBlockCount = 1;
constexpr uint32_t kGrowth = 2;
constexpr uint32_t kMostSamplesAtOnce = 64;
constexpr double kMemory = 0.8;

/// Part of the samples that finds out where the others are wanted, and the fewest and the most of them.
constexpr int64_t kPilotShare = 8;
constexpr int64_t kLeastPilot = 4;
constexpr int64_t kMostPilot = 32;
/// The pilot's random numbers are others than those of the picture.
constexpr uint32_t kPilotSeed = 0x9e3779b9u;

uint32_t pilotSamples(const RenderSettings& settings) {
    if (!settings.adaptive) return 0;
    if (settings.sampler == "stratified")
        throw Error("--adaptive wants another --sampler: stratified gives all pixels the same number of samples");
    if (const uint32_t least = leastSamples(settings); settings.spp < least)
        throw Error("--adaptive wants --spp " + std::to_string(least) + " at least: some find out where the noise is");
    return static_cast<uint32_t>(std::clamp(settings.spp / kPilotShare, kLeastPilot, kMostPilot));
}

constexpr BindingInfo kFilmBinding{shared::kBindFilm, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC};

/// A wavefront shades in compute shaders whatever traces.
KernelLayout makeLayout(const Device& device, const PreparedScene& prepared, bool isWavefront) {
    std::vector<BindingInfo> bindings = sceneBindings(prepared);
    bindings.push_back(kFilmBinding);
    bindings.push_back({shared::kBindSampleRates, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER});
    if (!isWavefront) return KernelLayout(device, bindings, sizeof(shared::RenderPush), prepared.tracer->stages());
    for (const BindingInfo& info : Wavefront::bindings()) bindings.push_back(info);
    return KernelLayout(device, bindings, sizeof(shared::WavefrontPush),
                        prepared.tracer->stages() | VK_SHADER_STAGE_COMPUTE_BIT);
}

/// All that the kernel is specialised to; the size of the stack last.
std::vector<SpecConstant> kernelConstants(const PreparedScene& prepared, const RenderSettings& settings) {
    std::vector<SpecConstant> constants = renderConstants(settings);
    const std::vector<SpecConstant> ofScene = sceneConstants(prepared);
    constants.insert(constants.end(), ofScene.begin(), ofScene.end());
    constants.push_back({shared::kSpecStackSize, prepared.tracer->traceData().stackEntries});
    return constants;
}

/// Whether a kernel made with some constants does what others ask for: its stack may be deeper.
bool covers(const std::vector<SpecConstant>& made, const std::vector<SpecConstant>& wanted) {
    return !made.empty() && std::equal(made.begin(), made.end() - 1, wanted.begin(), wanted.end() - 1) &&
           made.back().value >= wanted.back().value;
}

}  // namespace

uint32_t leastSamples(const RenderSettings& settings) {
    return settings.adaptive ? static_cast<uint32_t>(2 * kLeastPilot) : 1;
}

Renderer::Renderer(Device& device, const Scene& scene, const RenderSettings& settings)
    : Renderer(device, std::make_shared<PreparedScene>(prepareScene(device, scene, settings)), settings) {}

Renderer::Renderer(Device& device, std::shared_ptr<PreparedScene> prepared, const RenderSettings& settings)
    : device_(device),
      settings_(settings),
      prepared_(std::move(prepared)),
      frame_(makeFrame(*prepared_, settings)),
      film_(device, frame_.width, frame_.height) {
    Stopwatch watch;
    begin();
    times_.build = prepared_->tracer->buildSeconds();
    times_.upload = prepared_->tracer->uploadSeconds() + prepared_->packSeconds + watch.restart();
    makeKernel();
    times_.compile = watch.restart();
}

/// With an empty film and the frame parameters as they are.
void Renderer::begin() {
    pilotSamples_ = pilotSamples(settings_);
    if (pilotSamples_ > 0) frame_.seed ^= kPilotSeed;
    chooseSchedule();
    bindScene(device_, *prepared_, layout_);
    uploadFrame();
    bindBuffer(device_, layout_, kFilmBinding, film_.buffer(), 0, film_.bandBytes());
    const uint32_t tileRows = (frame_.height + shared::kTileSize - 1) / shared::kTileSize;
    blockCount_ = frame_.tilesPerRow * tileRows * kBlocksPerTile;
    bindRates(std::vector<float>(settings_.adaptive ? blockCount_ : 1, 1.0f));
    leastRate_ = 1.0;
    meanRate_ = 1.0;
    mostRate_ = 1.0;
    firstKept_ = 0;
    nextBlock_ = 0;
    passFirst_ = 0;
    passSamples_ = 1;
    passSeconds_ = 0.0;
    pixelSamples_ = 0.0;
    times_.render = 0.0;
    times_.device = 0.0;
    times_.denoise = 0.0;
    times_.denoiseDevice = 0.0;
    times_.longestDispatch = 0.0;
    if (denoiser_) denoiser_->forgetGuides();
}

/// The layout of the kernels by the settings' schedule, and the buffers of a wavefront, where those at hand are others.
void Renderer::chooseSchedule() {
    const std::optional<WavefrontPlan> plan = planWavefront(device_, *prepared_, settings_);
    const bool fits = plan ? wavefront_ && wavefront_->plan() == *plan : !wavefront_;
    if (fits && layout_.set != VK_NULL_HANDLE) return;
    layout_ = makeLayout(device_, *prepared_, plan.has_value());
    wavefront_ = plan ? std::make_unique<Wavefront>(device_, *plan, layout_) : nullptr;
    kernelConstants_.clear();
}

void Renderer::makeKernel() {
    kernelConstants_ = kernelConstants(*prepared_, settings_);
    kernel_ = {};
    if (wavefront_)
        wavefront_->makeKernels(device_, *prepared_, layout_, renderConstants(settings_));
    else
        kernel_ = makeSceneKernel(device_, *prepared_, layout_, KernelKind::render, renderConstants(settings_));
    dispatch(0, 1, 0, 0);  // lavapipe compiles at the first dispatch
    lastBlockCount_ = 0;
    times_.device = 0.0;
    times_.longestDispatch = 0.0;
}

void Renderer::startOver(const shared::FrameParams& frame) {
    const bool sameSize = frame.width == frame_.width && frame.height == frame_.height;
    frame_ = frame;
    if (sameSize)
        film_.clear(device_);
    else
        film_ = Film(device_, frame_.width, frame_.height);
    begin();
}

void Renderer::restart(const RenderSettings& settings, const Camera& camera) {
    settings_ = settings;
    prepared_->camera = camera;
    startOver(makeFrame(*prepared_, settings_));
    if (!covers(kernelConstants_, kernelConstants(*prepared_, settings_))) makeKernel();
}

void Renderer::restart(uint32_t seed, uint32_t spp) {
    settings_.seed = seed;
    settings_.spp = spp;
    startOver(makeFrame(*prepared_, settings_));
}

void Renderer::update(const Scene& scene, const SceneChange& change) {
    updateScene(device_, scene, change, *prepared_);
    startOver(makeFrame(*prepared_, settings_));
    if (!covers(kernelConstants_, kernelConstants(*prepared_, settings_))) makeKernel();
}

void Renderer::updateShading(const Scene& scene) {
    raylab::updateShading(device_, scene, *prepared_);
    startOver(makeFrame(*prepared_, settings_));
    if (!covers(kernelConstants_, kernelConstants(*prepared_, settings_))) makeKernel();
}

void Renderer::uploadFrame() {
    frameBuffer_ =
        makeDeviceBuffer(device_, "frame", std::as_bytes(std::span(&frame_, 1)), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    bindBuffer(device_, layout_, {shared::kBindFrame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}, frameBuffer_.get(), 0,
               frameBuffer_.sizeBytes());
}

void Renderer::bindRates(std::span<const float> rates) {
    rates_ = makeTexelBuffer(device_, "sample rates", std::as_bytes(rates), VK_FORMAT_R32_SFLOAT, sizeof(float));
    bindTexelView(device_, layout_, shared::kBindSampleRates, rates_.view.get());
}

/// The pilot's samples leave the film, and the picture begins.
void Renderer::finishPilot() {
    AdaptiveConfig config;
    config.samples = static_cast<double>(settings_.spp) - pilotSamples_;
    config.targetError = settings_.targetError;
    const std::vector<float> rates = sampleRates(film_.read(device_), config);
    const auto [least, most] = std::minmax_element(rates.begin(), rates.end());
    leastRate_ = static_cast<double>(*least);
    mostRate_ = static_cast<double>(*most);
    meanRate_ = std::accumulate(rates.begin(), rates.end(), 0.0) / static_cast<double>(rates.size());
    bindRates(rates);
    frame_.seed ^= kPilotSeed;
    uploadFrame();
    film_.clear(device_);
    firstKept_ = pilotSamples_;
    passFirst_ = pilotSamples_;
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
        if (wavefront_)
            wavefront_->record(device_, commands, layout_,
                               {push, tileCount, pathsPerLane(sampleCount), offset, frame_.maxDepth,
                                prepared_->gpu->bounds()});
        else
            launch(device_, commands, layout_, kernel_, std::span(&offset, 1), &push, tileCount);
    });
    times_.device += seconds;
    times_.longestDispatch = std::max(times_.longestDispatch, seconds);
    return seconds;
}

/// Samples of a pixel at most. Where blocks have rates, the kernel rounds their first and last in floats.
uint32_t Renderer::pathsPerLane(uint32_t sampleCount) const {
    return settings_.adaptive ? static_cast<uint32_t>(std::ceil(mostRate_ * sampleCount)) + 1 : sampleCount;
}

bool Renderer::regenerates() const { return !wavefront_ && settings_.integrator == "path"; }

/// Blocks whose paths a wavefront holds.
uint32_t Renderer::mostBlocks() const {
    return wavefront_ ? wavefront_->plan().capacity / (pathsPerLane(passSamples_) * kBlockLanes) : blockCount_;
}

/// Blocks of the next dispatch: within the pass, within the film band, and about as many as a slice holds.
uint32_t Renderer::chooseBlockCount() const {
    const uint32_t blocksPerBand = film_.rowsPerBand() / shared::kTileSize * frame_.tilesPerRow * kBlocksPerTile;
    const uint32_t bandEnd = std::min((nextBlock_ / blocksPerBand + 1) * blocksPerBand, blockCount_);
    uint32_t count = kFirstBlockCount;
    if (lastBlockCount_ > 0) {
        const double perBlock = std::max(secondsPerBlockSample_ * passSamples_, 1e-9);
        const double fitting = std::clamp(settings_.sliceMs * 1e-3 / perBlock, 1.0, 1e9);
        count = std::min({static_cast<uint32_t>(fitting), lastBlockCount_ * kGrowth, mostBlocks()});
    }
    const uint32_t inTile = nextBlock_ % kBlocksPerTile;
    if (inTile != 0 || count < kBlocksPerTile) return std::min(count, kBlocksPerTile - inTile);
    return std::min(count / kBlocksPerTile * kBlocksPerTile, bandEnd - nextBlock_);
}

/// Samples of the next pass: several where the whole image takes less than a slice, or where lanes go on from one to the
/// next (film/render_main.glsl). Not many more than there are, so that pixels have about as many while a pass is under way.
void Renderer::chooseSampleCount() {
    const double slice = settings_.sliceMs * 1e-3, perSample = std::max(passSeconds_ / passSamples_, 1e-9);
    // The smallest dispatch is one block.
    const double ofBlock = std::clamp(slice / std::max(secondsPerBlockSample_, 1e-9), 1.0, static_cast<double>(mostOfPass_));
    const double fitting = std::clamp(slice / perSample, regenerates() ? ofBlock : 1.0, double{kMostSamplesAtOnce});
    const int64_t end = passFirst_ < pilotSamples_ ? int64_t{pilotSamples_} : settings_.spp;
    const auto remaining = static_cast<uint32_t>(end - passFirst_);
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
    pixelSamples_ += meanRate_ * count * kBlockLanes * passSamples_;
    nextBlock_ += count;
    if (nextBlock_ == blockCount_) {
        nextBlock_ = 0;
        passFirst_ += passSamples_;
        if (passFirst_ == pilotSamples_) finishPilot();
        chooseSampleCount();
    }
    return passFirst_ < static_cast<uint64_t>(settings_.spp);
}

bool Renderer::denoises() const {
    return settings_.denoise != kNoDenoiser && !findIntegrator(settings_.integrator).isView;
}

FilmImage Renderer::develop(const std::function<bool()>& stop) {
    FilmImage image = snapshot();
    times_.denoise = 0.0;
    times_.denoiseDevice = 0.0;
    if (!denoises()) return image;
    const Stopwatch watch;
    if (!denoiser_) denoiser_ = std::make_unique<PictureDenoiser>(device_);
    if (auto picture = denoiser_->filter(image, prepared_, settings_, stop)) image.denoised = std::move(*picture);
    times_.denoise = watch.seconds();
    times_.denoiseDevice = denoiser_->deviceSeconds();
    return image;
}

double Renderer::fractionDone() const {
    const double inPass = static_cast<double>(nextBlock_) / blockCount_ * passSamples_;
    return (passFirst_ + inPass) / static_cast<double>(settings_.spp);
}

}  // namespace raylab
