#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>

#include "engine/image/image_io.h"
#include "engine/measure/image_error.h"
#include "ui/cli/commands.h"
#include "ui/cli/options.h"

namespace raylab {
namespace {

struct CompareOptions {
    std::string image;
    std::string reference;
    std::string heat;
    std::string json;
    double maxRmse = std::numeric_limits<double>::infinity();
    double maxRelMse = std::numeric_limits<double>::infinity();
};

/// JSON has no infinity: identical images have a PSNR of null.
nlohmann::ordered_json finiteOrNull(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

/// Fraction of pixels that pass a Z-test where both files carry variance and sample layers; NaN otherwise.
double zTestPassFraction(const CompareOptions& options) {
    const auto meanAndError = [](const std::string& path, Bitmap& mean, Bitmap& varianceOfMean) {
        if (!path.ends_with(".exr")) return false;
        const Bitmap *variance = nullptr, *samples = nullptr;
        const std::vector<Layer> layers = readExrLayers(path);
        for (const Layer& layer : layers) {
            if (layer.name.empty()) mean = layer.bitmap;
            if (layer.name == "variance") variance = &layer.bitmap;
            if (layer.name == "samples") samples = &layer.bitmap;
        }
        if (variance == nullptr || samples == nullptr) return false;
        varianceOfMean = *variance;
        for (size_t i = 0; i < varianceOfMean.pixels.size(); ++i)
            varianceOfMean.pixels[i] /= std::max(1.0f, samples->pixels[i / static_cast<size_t>(variance->channels)]);
        return true;
    };
    Bitmap a, va, b, vb;
    if (!meanAndError(options.image, a, va) || !meanAndError(options.reference, b, vb))
        return std::numeric_limits<double>::quiet_NaN();
    return zTest(a, va, b, vb).passFraction;
}

ExitCode compare(const CompareOptions& options) {
    const Bitmap image = readImage(options.image), reference = readImage(options.reference);
    const ImageError error = compareImages(image, reference);
    if (!options.heat.empty()) writePng(options.heat, errorHeatMap(image, reference));
    const bool passed = error.rmse <= options.maxRmse && error.relMse <= options.maxRelMse && error.nonFinite == 0;
    const double passFraction = zTestPassFraction(options);
    if (!options.json.empty())
        writeJson(options.json, {{"schema", "raylab.compare/1"},
                                 {"image", options.image},
                                 {"reference", options.reference},
                                 {"pixels", error.pixels},
                                 {"nonFinite", error.nonFinite},
                                 {"mse", finiteOrNull(error.mse)},
                                 {"rmse", finiteOrNull(error.rmse)},
                                 {"relMse", finiteOrNull(error.relMse)},
                                 {"psnr", finiteOrNull(error.psnr)},
                                 {"maxAbs", finiteOrNull(error.maxAbs)},
                                 {"zTestPassFraction", finiteOrNull(passFraction)},
                                 {"passed", passed}});
    if (options.json != "-") {
        std::cout << std::setprecision(6) << "MSE     " << error.mse << "\nRMSE    " << error.rmse << "\nrelMSE  " << error.relMse
                  << "\nPSNR    " << error.psnr << " dB\nmax     " << error.maxAbs << "\n";
        if (std::isfinite(passFraction)) std::cout << "Z-test  " << 100.0 * passFraction << " % of pixels pass\n";
        if (error.nonFinite > 0) std::cout << error.nonFinite << " pixels are not finite and are left out\n";
    }
    return passed ? ExitCode::done : ExitCode::checkFailed;
}

}  // namespace

void addCompareCommand(CLI::App& app, Command& chosen) {
    CLI::App* command = app.add_subcommand("compare", "measure how far an image is from a reference");
    const auto options = std::make_shared<CompareOptions>();
    command->add_option("image", options->image, "PNG, JPEG, HDR or EXR")->required();
    command->add_option("reference", options->reference, "what it should look like")->required();
    command->add_option("--heat", options->heat, "write a map of the squared relative error as PNG")->type_name("FILE");
    command->add_option("--max-rmse", options->maxRmse, "exit with 1 where the RMSE is larger");
    command->add_option("--max-relmse", options->maxRelMse, "exit with 1 where the relMSE is larger");
    command->add_option("--json", options->json, "write the figures to a file, or - for standard output")->type_name("FILE");
    command->callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

}  // namespace raylab
