#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/image/bitmap.h"
#include "engine/measure/stability/evidence.h"
#include "engine/measure/stability/plot.h"
#include "engine/render/render_settings.h"

/// The stability battery: where ray tracers fail, a number for each failure, on each configuration.
namespace raylab::stability {

/// Axes that configurations differ along, as bits.
enum Axis : unsigned {
    kAxisNone = 0,
    kAxisTriangle = 1u << 0,
    kAxisSlab = 1u << 1,
    kAxisOffset = 1u << 2,
    kAxisLayout = 1u << 3,
    kAxisTracer = 1u << 4,
    kAxisBrute = 1u << 5,  ///< the tracer without a tree, which is too slow for most images
};

/// Settings to measure under.
struct Config {
    std::string name;
    RenderSettings settings;
    unsigned axes = kAxisNone;  ///< along which it differs from the default; none: the default
    std::string missing;        ///< what the device lacks to run it; empty where it runs
    bool isDefault() const { return axes == kAxisNone; }
};

/// Names of sets for configsOf().
std::vector<std::string> configSets();
/// "default": that alone. "triangles", "slabs", "offsets", "layouts", "tracers": the default and what differs from it
/// in one setting. "all": all of these. "product": triangle tests x slab tests x offsets x layouts, and the tracers.
/// Throws Error for another name.
std::vector<Config> configsOf(const std::string& set, const DeviceDescription& device);

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// One number that a case measured.
struct Number {
    std::string what;
    double value = 0.0;       ///< the smaller the better
    double limit = kNoLimit;  ///< passes up to here; kNoLimit: reported only
    std::string unit;
    std::string note;               ///< what else is worth knowing
    std::optional<Bitmap> picture;  ///< display-referred: of where it fails, or of what a number without limit is about
    std::optional<Evidence> evidence = std::nullopt;  ///< to be looked at; where the case has such
    std::optional<Plot> plot = std::nullopt;          ///< of how the number comes about
    bool passes() const { return value <= limit; }
};

/// A number of things of which there must be none.
inline Number countOf(std::string what, size_t count, std::string unit, std::string note) {
    return {std::move(what), static_cast<double>(count), 0.0, std::move(unit), std::move(note), std::nullopt};
}

/// A case that cannot be run here says why.
class Skipped : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Thrown by Context::check() where the user or the time limit says stop.
class Stopped : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What a case runs on.
struct Context {
    Device& device;
    RenderSettings settings;          ///< of the configuration
    bool quick = false;               ///< a tenth of the rays, small images
    std::filesystem::path scenes{};   ///< folder of scenes that are not raylab's own; empty: none
    std::filesystem::path program{};  ///< raylab itself, for cases that start it; empty: none
    std::function<bool()> goesOn{};   ///< asked often; nothing: always
    /// Another device in the place of a lost one, of which nothing is left; nothing: a loss ends the battery.
    std::function<Device*()> replaceDevice{};

    size_t rays(size_t full) const { return quick ? full / 10 : full; }
    /// Throws Stopped.
    void check() const;
    /// Path of a file among the scenes. Throws Skipped.
    std::filesystem::path sceneFile(const std::string& relativePath) const;
    bool isTracedByDriver() const { return settings.tracer == "query" || settings.tracer == "pipeline"; }
    bool hasTree() const { return settings.tracer == "software"; }
};

struct Case {
    std::string_view id;
    std::string_view provokes;
    unsigned axes;  ///< that its numbers may depend on: configurations that differ along none of them are left out
    std::vector<Number> (*measure)(const Context& context);
};

/// All cases, in the order of their ids; what needs a file of its own is a case of its own under the same id.
std::span<const Case> cases();
/// Those of an id. Throws Error, naming the ids that there are.
std::vector<const Case*> casesOf(std::string_view id);

/// A number, as the reports have it; or a case that was skipped or failed.
struct Row {
    std::string id;
    std::string provokes;
    std::string config;
    bool isDefault = false;
    Number number;
    std::string skipped;   ///< why there is no number; empty where there is one
    double seconds = 0.0;  ///< of the case on this configuration

    bool passes() const { return skipped.empty() && number.passes(); }
    bool fails() const { return skipped.empty() && !number.passes(); }
};

struct Plan {
    std::vector<const Case*> cases;
    std::vector<Config> configs;
};

/// Told after each case with its rows, and before it with none.
using BatteryProgress = std::function<void(const Case& which, const Config& config, std::span<const Row> rows)>;

struct BatteryResult {
    std::vector<Row> rows;
    bool complete = true;  ///< false: stopped before, or without a device
};

/// Runs the plan's cases under each configuration that they may depend on; `context` without its settings. A case that
/// throws, or loses its device, is a row that fails, with the message; after a loss the next case has another device.
BatteryResult runBattery(const Plan& plan, const Context& context, const BatteryProgress& progress);

}  // namespace raylab::stability
