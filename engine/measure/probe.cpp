#include "engine/measure/probe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "engine/measure/image_error.h"
#include "engine/measure/statistics.h"
#include "engine/render/lighting.h"
#include "engine/render/renderer.h"

namespace raylab {
namespace {

/// Bias that is not this many standard errors from 0 is none.
constexpr double kClearBias = 2.0;
/// Of the squared error that is aimed at, what must be left to noise.
constexpr double kLeastRoom = 0.1;

double meanOfPixels(const Bitmap& bitmap) {
    return std::accumulate(bitmap.pixels.begin(), bitmap.pixels.end(), 0.0) / static_cast<double>(bitmap.pixels.size());
}

double meanOfSeeds(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// A candidate while it is measured.
struct Subject {
    std::unique_ptr<Renderer> renderer;  ///< none any more where there is no hope
    SeedImages images{1, 1, 1};
    Probe probe;
};

bool renderAll(Renderer& renderer, uint32_t seed, uint32_t samples, const std::function<bool()>& stop) {
    renderer.restart(seed, samples);
    while (renderer.step())
        if (stop()) return false;
    return true;
}

Subject makeSubject(Device& device, Scene scene, RenderSettings settings, const Bitmap& reference) {
    settings.spp = leastSamples(settings);
    settleEnvironment(scene, settings);
    Subject subject{std::make_unique<Renderer>(device, scene, settings),
                    SeedImages(reference.width, reference.height, reference.channels),
                    {}};
    subject.probe.buildSeconds = subject.renderer->times().build;
    return subject;
}

/// Whether all seeds so far say that the candidate, bias apart, takes `factor` times as long as the first one to the same
/// error.
bool isHopeless(const Probe& first, const Probe& candidate, double factor) {
    const double bias = candidate.biasSquared();
    for (size_t seed = 0; seed < candidate.sampleSeconds.size(); ++seed) {
        const double error = first.squaredErrors[seed];
        const bool isMuchSlower = (candidate.squaredErrors[seed] - bias) * candidate.sampleSeconds[seed] >
                                  factor * error * first.sampleSeconds[seed];
        if (error <= 0.0 || !isMuchSlower) return false;
    }
    return true;
}

}  // namespace

double Probe::biasSquared() const {
    return bias.biasSquared > kClearBias * bias.standardError ? bias.biasSquared : 0.0;
}

double Probe::rmsError() const { return std::sqrt(std::max(0.0, meanOfSeeds(squaredErrors))); }

double Probe::sampleVariance() const { return std::max(0.0, meanOfSeeds(squaredErrors) - biasSquared()) * samples; }

double Probe::medianSampleSeconds() const { return medianOf(sampleSeconds); }

double Probe::secondsToError(double relativeError, size_t seed) const {
    const double aim = relativeError * relativeError, room = aim - biasSquared();
    if (room < kLeastRoom * aim) return std::numeric_limits<double>::infinity();
    const double variance = std::max(0.0, squaredErrors[seed] - biasSquared()) * samples;
    return buildSeconds + std::max(1.0, variance / room) * sampleSeconds[seed];
}

double Probe::errorAfter(double seconds) const {
    const double count = std::max(1.0, seconds / medianSampleSeconds());
    return std::sqrt(biasSquared() + sampleVariance() / count);
}

std::optional<std::vector<Probe>> probe(Device& device, const Scene& scene, std::span<const RenderSettings> candidates,
                                        const Reference& reference, const ProbePlan& plan,
                                        const std::function<bool()>& stop) {
    const Bitmap weights = errorWeights(reference.image.mean, true);
    const double noise = referenceNoise(reference.image, weights);
    std::vector<Subject> subjects;
    for (const RenderSettings& settings : candidates) {
        subjects.push_back(makeSubject(device, scene, settings, reference.image.mean));
        if (!renderAll(*subjects.back().renderer, plan.firstSeed, leastSamples(settings), stop)) return std::nullopt;
        subjects.back().renderer->develop(stop);  // a denoiser's kernels are made now
    }
    for (int seed = 0; seed < plan.seeds; ++seed) {
        if (seed == plan.seedsToHope)
            for (size_t i = 1; i < subjects.size(); ++i) {
                subjects[i].probe.bias = subjects[i].images.estimate(reference.image, weights);
                if (isHopeless(subjects[0].probe, subjects[i].probe, plan.hopeless)) subjects[i].renderer.reset();
            }
        for (size_t i = 0; i < subjects.size(); ++i) {
            Subject& subject = subjects[seed % 2 == 0 ? i : subjects.size() - 1 - i];
            if (!subject.renderer) continue;
            if (!renderAll(*subject.renderer, plan.firstSeed + static_cast<uint32_t>(seed), plan.samples, stop))
                return std::nullopt;
            const Bitmap image = subject.renderer->develop(stop).picture();
            if (stop()) return std::nullopt;
            subject.images.add(image);
            const RenderTimes& times = subject.renderer->times();
            subject.probe.sampleSeconds.push_back((times.device + times.denoiseDevice) / plan.samples);
            subject.probe.squaredErrors.push_back(compareImages(image, reference.image.mean).relMse - noise);
        }
    }
    std::vector<Probe> probes;
    for (Subject& subject : subjects) {
        subject.probe.samples = plan.samples;
        subject.probe.bias = subject.images.estimate(reference.image, weights);
        subject.probe.energy = meanOfPixels(subject.images.mean()) / meanOfPixels(reference.image.mean);
        probes.push_back(std::move(subject.probe));
    }
    return probes;
}

}  // namespace raylab
