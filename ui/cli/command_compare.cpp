#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>

#include "engine/image/image_io.h"
#include "engine/measure/flip.h"
#include "engine/measure/image_error.h"
#include "engine/measure/ssim.h"
#include "ui/cli/commands.h"
#include "ui/cli/options.h"

namespace raylab {
namespace {

using Json = nlohmann::ordered_json;

struct CompareOptions {
    std::string image;
    std::string reference;
    std::string crop;
    std::string mask;
    std::string heat;
    std::string flipMap;
    std::string ssimMap;
    std::string json;
    double pixelsPerDegree = kFlipPixelsPerDegree;
    std::optional<double> maxRmse, maxRelMse, maxFlip, minSsim, minZTest;
};

/// An image with the variance of its pixels' means, where its file has that.
struct Estimate {
    Bitmap mean;
    std::optional<Bitmap> varianceOfMean;
};

/// What is compared: both images cropped, and the pixels of the crop that count (empty: all).
struct Subject {
    Estimate image, reference;
    PixelMask mask;
};

struct HdrFlip {
    double mean = 0.0;
    FlipExposures exposures;
};

struct Figures {
    ImageError error;
    double ssim = 0.0;
    double flip = 0.0;
    std::optional<HdrFlip> flipHdr;
    std::optional<ZTest> zTest;
    bool passed = false;
};

constexpr double kZTestSignificance = 0.01;

/// JSON has no infinity: identical images have a PSNR of null.
Json finiteOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(); }

PixelRect parseCrop(const std::string& text) {
    PixelRect rect;
    std::istringstream stream(text);
    char comma[3] = {};
    stream >> rect.x >> comma[0] >> rect.y >> comma[1] >> rect.width >> comma[2] >> rect.height;
    const bool commas = std::ranges::all_of(comma, [](char c) { return c == ','; });
    if (!stream || !commas || stream.peek() != std::char_traits<char>::eof())
        throw Error("--crop takes x,y,width,height in pixels, such as 0,0,64,64, not '" + text + "'");
    return rect;
}

/// The layers that raylab render writes: variance of one sample, and number of samples.
std::optional<Bitmap> readVarianceOfMean(const std::string& path) {
    if (!path.ends_with(".exr")) return std::nullopt;
    const std::vector<Layer> layers = readExrLayers(path);
    const auto variance = std::ranges::find(layers, "variance", &Layer::name);
    const auto samples = std::ranges::find(layers, "samples", &Layer::name);
    if (variance == layers.end() || samples == layers.end()) return std::nullopt;
    Bitmap result = variance->bitmap;
    if (samples->bitmap.channels != 1 || samples->bitmap.pixelCount() != result.pixelCount())
        throw Error(path + ": its layer 'samples' does not fit its layer 'variance'; write it anew with raylab render");
    for (size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] /= std::max(1.0f, samples->bitmap.pixels[i / static_cast<size_t>(result.channels)]);
    return result;
}

Estimate readEstimate(const std::string& path) { return {readImage(path), readVarianceOfMean(path)}; }

Estimate cropped(const Estimate& estimate, const PixelRect& rect) {
    Estimate part = {cropped(estimate.mean, rect), std::nullopt};
    if (estimate.varianceOfMean) part.varianceOfMean = cropped(*estimate.varianceOfMean, rect);
    return part;
}

Bitmap readMaskPicture(const std::string& path, const Bitmap& image) {
    Bitmap picture = readImage(path);
    if (picture.width != image.width || picture.height != image.height)
        throw Error(path + ": has " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                    " pixels, the images have " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                    "; give a mask of their size");
    return picture;
}

Subject readSubject(const CompareOptions& options) {
    Subject subject = {readEstimate(options.image), readEstimate(options.reference), {}};
    requireSameShape(subject.image.mean, subject.reference.mean);
    std::optional<Bitmap> mask;
    if (!options.mask.empty()) mask = readMaskPicture(options.mask, subject.image.mean);
    if (!options.crop.empty()) {
        const PixelRect rect = parseCrop(options.crop);
        subject.image = cropped(subject.image, rect);
        subject.reference = cropped(subject.reference, rect);
        if (mask) mask = cropped(*mask, rect);
    }
    if (!mask) return subject;
    subject.mask = maskOf(*mask);
    if (std::ranges::find_if(subject.mask, [](uint8_t counts) { return counts != 0; }) == subject.mask.end())
        throw Error(options.mask + ": leaves out every pixel; what is to be compared must not be black");
    return subject;
}

bool exceedsDisplay(const Bitmap& bitmap) {
    return std::ranges::any_of(bitmap.pixels, [](float value) { return value > 1.0f; });
}

std::optional<HdrFlip> hdrFlip(const Subject& subject, double pixelsPerDegree) {
    const Bitmap &image = subject.image.mean, &reference = subject.reference.mean;
    if (!exceedsDisplay(image) && !exceedsDisplay(reference)) return std::nullopt;
    const FlipExposures exposures = hdrFlipExposures(reference);
    return HdrFlip{meanOf(hdrFlipMap(image, reference, exposures, pixelsPerDegree), subject.mask), exposures};
}

std::optional<ZTest> zTest(const Subject& subject) {
    const Estimate &a = subject.image, &b = subject.reference;
    if (!a.varianceOfMean || !b.varianceOfMean) return std::nullopt;
    return zTest(a.mean, *a.varianceOfMean, b.mean, *b.varianceOfMean, kZTestSignificance, subject.mask);
}

/// Throws Error where a limit was given for a figure that these images do not have.
bool withinLimits(const CompareOptions& options, const Figures& figures) {
    if (options.minZTest && !figures.zTest)
        throw Error("--min-ztest: " + options.image + " and " + options.reference +
                    " do not both carry variance and samples; write them as EXR with raylab render");
    if (options.minSsim && std::isnan(figures.ssim))
        throw Error(
            "--min-ssim: there is no whole window of 11 x 11 pixels to compare; give a larger part of the image");
    const auto atMost = [](double value, const std::optional<double>& limit) { return !limit || value <= *limit; };
    const auto atLeast = [](double value, const std::optional<double>& limit) { return !limit || value >= *limit; };
    return figures.error.nonFinite == 0 && atMost(figures.error.rmse, options.maxRmse) &&
           atMost(figures.error.relMse, options.maxRelMse) && atMost(figures.flip, options.maxFlip) &&
           atLeast(figures.ssim, options.minSsim) &&
           (!figures.zTest || atLeast(figures.zTest->passFraction, options.minZTest));
}

/// Also writes the maps that were asked for.
Figures measure(const CompareOptions& options, const Subject& subject) {
    const Bitmap &image = subject.image.mean, &reference = subject.reference.mean;
    const Bitmap ssim = ssimMap(image, reference), flip = flipMap(image, reference, options.pixelsPerDegree);
    Figures figures;
    figures.error = compareImages(image, reference, subject.mask);
    figures.ssim = meanOf(ssim, subject.mask);
    figures.flip = meanOf(flip, subject.mask);
    figures.flipHdr = hdrFlip(subject, options.pixelsPerDegree);
    figures.zTest = zTest(subject);
    figures.passed = withinLimits(options, figures);
    if (!options.heat.empty()) writePng(options.heat, errorHeatMap(image, reference, subject.mask));
    if (!options.flipMap.empty()) writePng(options.flipMap, heatPicture(flip, 0.0, 1.0, subject.mask));
    if (!options.ssimMap.empty()) writePng(options.ssimMap, heatPicture(ssim, 1.0, 0.0, subject.mask));
    return figures;
}

Json figuresJson(const CompareOptions& options, const Figures& figures) {
    const ImageError& error = figures.error;
    Json json = {{"schema", "raylab.compare/1"},
                 {"image", options.image},
                 {"reference", options.reference},
                 {"crop", options.crop.empty() ? Json() : Json(options.crop)},
                 {"mask", options.mask.empty() ? Json() : Json(options.mask)},
                 {"pixels", error.pixels},
                 {"nonFinite", error.nonFinite},
                 {"mse", finiteOrNull(error.mse)},
                 {"rmse", finiteOrNull(error.rmse)},
                 {"relMse", finiteOrNull(error.relMse)},
                 {"psnr", finiteOrNull(error.psnr)},
                 {"maxAbs", finiteOrNull(error.maxAbs)},
                 {"ssim", finiteOrNull(figures.ssim)},
                 {"flip", finiteOrNull(figures.flip)},
                 {"flipHdr", figures.flipHdr ? finiteOrNull(figures.flipHdr->mean) : Json()},
                 {"pixelsPerDegree", options.pixelsPerDegree},
                 {"zTestPassFraction", figures.zTest ? Json(figures.zTest->passFraction) : Json()}};
    if (const std::optional<HdrFlip>& hdr = figures.flipHdr)
        json["flipHdrExposures"] = {
            {"startStops", hdr->exposures.start}, {"stopStops", hdr->exposures.stop}, {"count", hdr->exposures.count}};
    json["zTest"] = nullptr;
    if (const std::optional<ZTest>& test = figures.zTest)
        json["zTest"] = {{"passFraction", test->passFraction},
                         {"pixels", test->pixels},
                         {"threshold", test->threshold},
                         {"significance", test->significance},
                         {"passed", test->passed}};
    json["passed"] = figures.passed;
    return json;
}

void print(const Figures& figures) {
    const ImageError& error = figures.error;
    std::cout << std::setprecision(6) << "MSE     " << error.mse << "\nRMSE    " << error.rmse << "\nrelMSE  "
              << error.relMse << "\nPSNR    " << error.psnr << " dB\nmax     " << error.maxAbs << "\nSSIM    ";
    if (std::isnan(figures.ssim))
        std::cout << "- (no whole window of " << kSsimWindow << " x " << kSsimWindow << " pixels)";
    else
        std::cout << figures.ssim;
    std::cout << "\nFLIP    " << figures.flip << "\n";
    if (const std::optional<HdrFlip>& hdr = figures.flipHdr)
        std::cout << "HDR-FLIP " << hdr->mean << " (" << hdr->exposures.count << " exposures, " << hdr->exposures.start
                  << " to " << hdr->exposures.stop << " stops)\n";
    if (const std::optional<ZTest>& test = figures.zTest)
        std::cout << "Z-test  " << 100.0 * test->passFraction << " % of " << test->pixels
                  << " pixels pass; equal means are " << (test->passed ? "not " : "")
                  << "rejected at a significance of " << test->significance << "\n";
    if (error.nonFinite > 0) std::cout << error.nonFinite << " pixels are not finite and are left out\n";
}

ExitCode compare(const CompareOptions& options) {
    const Figures figures = measure(options, readSubject(options));
    if (!options.json.empty()) writeJson(options.json, figuresJson(options, figures));
    if (options.json != "-") print(figures);
    return figures.passed ? ExitCode::done : ExitCode::checkFailed;
}

}  // namespace

void addCompareCommand(CLI::App& app, Command& chosen) {
    CLI::App* command = app.add_subcommand("compare", "measure how far an image is from a reference");
    const auto options = std::make_shared<CompareOptions>();
    const auto file = [&](const char* flag, std::string& path, const char* help) {
        command->add_option(flag, path, help)->type_name("FILE");
    };
    const auto limit = [&](const char* flag, std::optional<double>& value, const char* help) {
        command->add_option(flag, value, help)->type_name("NUMBER");
    };
    command->add_option("image", options->image, "PNG, JPEG, HDR or EXR")->required();
    command->add_option("reference", options->reference, "what it should look like")->required();
    command->add_option("--crop", options->crop, "compare a part only, in pixels from the top left")
        ->type_name("X,Y,W,H");
    file("--mask", options->mask, "leave out the pixels that are black in this image of the same size");
    file("--heat", options->heat, "write a map of the squared relative error as PNG");
    file("--flip-map", options->flipMap, "write a map of FLIP (LDR) as PNG, black 0 to white 1");
    file("--ssim-map", options->ssimMap, "write a map of SSIM as PNG, black 1 to white 0");
    command
        ->add_option("--pixels-per-degree", options->pixelsPerDegree, "how finely the viewer of FLIP sees, 1 to 1000")
        ->type_name("NUMBER")
        ->default_str("67.02");
    limit("--max-rmse", options->maxRmse, "exit with 1 where the RMSE is larger");
    limit("--max-relmse", options->maxRelMse, "exit with 1 where the relMSE is larger");
    limit("--max-flip", options->maxFlip, "exit with 1 where the mean FLIP (LDR) is larger");
    limit("--min-ssim", options->minSsim, "exit with 1 where the mean SSIM is smaller");
    limit("--min-ztest", options->minZTest, "exit with 1 where a smaller fraction of the pixels passes the Z-test");
    file("--json", options->json, "write the figures to a file, or - for standard output");
    command->callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

}  // namespace raylab
