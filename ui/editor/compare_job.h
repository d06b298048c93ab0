#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/image/bitmap.h"
#include "ui/editor/render_request.h"

namespace raylab {

/// How the viewport shows two renderings.
enum class CompareMode { off, wipe, checker, blink, sideBySide, absolute, relative, flip, zScore, firstHit };

struct CompareModeInfo {
    CompareMode mode;
    std::string_view name;
    std::string_view help;
};

std::span<const CompareModeInfo> compareModes();
const CompareModeInfo& infoOf(CompareMode mode);
/// Throws Error where there is none of that name.
CompareMode findCompareMode(std::string_view name);
/// The picture shows how A and B differ, and not A and B.
bool isDifference(CompareMode mode);

/// What errors are measured against.
enum class CompareReference {
    growing,  ///< the side that is less noisy by now; its own error is its noise, and the other's is at least its noise
    kept,     ///< a film that was kept, or an image file
};

/// The scale of a difference picture.
struct HeatScale {
    double low = 0.0;
    double high = 1.0;
    bool isLogarithmic = false;
};
HeatScale heatScaleOf(CompareMode mode);

/// What is compared.
struct CompareInput {
    CompareMode mode = CompareMode::off;
    std::shared_ptr<const Picture> a, b;
    CompareReference reference = CompareReference::growing;
    std::shared_ptr<const Bitmap> kept;  ///< of CompareReference::kept; nullptr or of another size: no errors
};

/// A picture that shows how two differ, and figures.
struct CompareResult {
    CompareMode mode = CompareMode::off;
    uint64_t numberA = 0, numberB = 0;  ///< of the pictures
    double secondsA = 0.0, secondsB = 0.0;
    bool isDenoisedA = false, isDenoisedB = false;
    std::string mismatch;  ///< why there is nothing else; empty where there is
    uint32_t width = 0, height = 0;
    std::vector<uint32_t> texels;  ///< none where the mode is no difference
    std::string figure;            ///< of the whole picture, with its name
    double figureValue = 0.0;
    std::optional<double> errorA, errorB;  ///< sqrt(relMse)
};

/// Takes up to a second: FLIP of large pictures.
CompareResult comparePictures(const CompareInput& input);

}  // namespace raylab
