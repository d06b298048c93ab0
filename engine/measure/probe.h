#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/measure/reference.h"
#include "engine/render/render_settings.h"
#include "engine/scene/scene.h"

namespace raylab {

/// What a few short renderings of one configuration say. Errors are squared relative errors (relMse), without what the
/// reference's own noise adds to them.
struct Probe {
    uint32_t samples = 0;               ///< a pixel, of each rendering
    std::vector<double> sampleSeconds;  ///< of the device, for a sample a pixel; one a seed
    std::vector<double> squaredErrors;  ///< one a seed; may be negative where all is noise of the reference
    BiasEstimate bias;                  ///< relative
    double energy = 0.0;                ///< mean radiance over the reference's
    double buildSeconds = 0.0;

    /// Unbiased estimate of the squared bias, or 0 where chance would explain it (two standard errors).
    double biasSquared() const;
    /// Root of the mean over the seeds of the squared error, bias included.
    double rmsError() const;
    /// Mean over the seeds of the squared error without bias, for one sample a pixel.
    double sampleVariance() const;
    double medianSampleSeconds() const;

    /// Seconds, by one seed's figures, to reach a relative error: the build, and as many samples as it takes where the
    /// noise falls as 1 / samples. Infinite where bias leaves less than a tenth of the squared error to noise.
    double secondsToError(double relativeError, size_t seed) const;
    /// The relative error that so many seconds of rendering come to.
    double errorAfter(double seconds) const;
};

struct ProbePlan {
    uint32_t samples = 1;
    int seeds = 4;
    uint32_t firstSeed = 0;
    /// Seeds after which a candidate is measured no longer where its squared error without bias, times its time, has been
    /// more than `hopeless` times the first candidate's each time; then its figures are of these seeds.
    int seedsToHope = 2;
    double hopeless = std::numeric_limits<double>::infinity();
};

/// Renders all candidates seed by seed, in turn, so that a drifting machine favours none; a first rendering of
/// leastSamples() of each is not counted. Nothing where `stop`, asked between dispatches, says so. The scene's environment must
/// not be settled.
std::optional<std::vector<Probe>> probe(Device& device, const Scene& scene, std::span<const RenderSettings> candidates,
                                        const Reference& reference, const ProbePlan& plan,
                                        const std::function<bool()>& stop);

}  // namespace raylab
