#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "engine/gpu/device.h"
#include "engine/measure/seed_images.h"
#include "engine/render/render_settings.h"
#include "engine/scene/scene.h"

namespace raylab {

/// Where references come from when they are no files.
enum class ReferenceKind {
    path,  ///< path tracing without any shortcut: what differs from it is bias
    own,   ///< the configuration itself with many samples: what differs from it is noise
};

/// Seeds of references are from here on, beyond what a chart measures.
constexpr uint32_t kFirstReferenceSeed = 0x80000000u;

/// The settings whose rendering `settings` converge to, or, for ReferenceKind::path, whose picture they are an
/// approximation of: what only costs or saves time or noise is at its default. Settings of equal result share a
/// reference.
RenderSettings referenceSettings(RenderSettings settings, ReferenceKind kind);

/// A rendering that others are measured against.
struct Reference {
    ReferenceImage image;
    double relativeError = 0.0;  ///< sqrt(relMse) of the image, estimated
    uint32_t samples = 0;        ///< a pixel, of all parts
    std::string origin;          ///< where it is from, for the reader
};

/// An image file; the variance is known where it is an EXR that raylab render wrote. It is not taken for anything else
/// than what it shows: linear radiance. Throws Error as readImage does, and unless it has the size that is wanted.
Reference readReference(const std::filesystem::path& path, int width, int height);

/// $XDG_CACHE_HOME/raylab/references, or ~/.cache/raylab/references; empty where the environment names neither.
std::filesystem::path referenceFolder();

/// The file of a reference in that folder: by what the scene holds, the settings and the version of this code.
std::filesystem::path referenceFile(const std::filesystem::path& folder, const Scene& scene,
                                    const RenderSettings& settings);

/// Renders in independent parts, until the error that these tell of each other is at most `relativeError`; each part
/// has a seed of its own. A file in `folder` that is as good is taken instead, and a new one is written there; with an
/// empty folder neither happens. `stop` is asked between dispatches; where it says so, nothing is returned. `progress`
/// gets the part that is done, of 1. `settings` as referenceSettings gives them; the scene's environment must not be
/// settled.
std::optional<Reference> obtainReference(Device& device, const Scene& scene, const RenderSettings& settings,
                                         double relativeError, const std::filesystem::path& folder,
                                         const std::function<bool()>& stop,
                                         const std::function<void(double)>& progress);

}  // namespace raylab
