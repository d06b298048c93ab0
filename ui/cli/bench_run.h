#pragma once

#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/gpu/device.h"
#include "engine/measure/ray_bench.h"
#include "ui/cli/options.h"

namespace raylab {

struct BenchOptions {
    explicit BenchOptions(CLI::App& command) : settings(command) {}

    SettingOptions settings;
    std::vector<std::string> scenes;
    std::vector<std::string> vary;
    std::vector<std::string> kinds;
    std::string light;
    std::string compare;
    std::string json;
    std::string csv;
    int repeats = 5;
    int64_t largest = 10'000'000;  ///< triangles, of --scaling
    bool noPeers = false;
    bool materials = false;
    bool tune = false;
    bool scaling = false;
    bool costs = false;
};

/// One configuration that is measured.
struct Variant {
    RenderSettings settings;
    std::string text;  ///< "name=value name=value", without what SubjectLabel has a column for
};

/// The grid that --vary spans over the base. Throws Error for what is no setting or no value of one.
std::vector<Variant> variantsOf(const RenderSettings& base, const std::vector<std::string>& vary);

/// What is measured on a scene.
struct BenchPlan {
    RenderSettings base;  ///< of the rays
    std::vector<Variant> variants;
    std::vector<std::string> kinds;  ///< of rays; empty: all
    std::string light;               ///< as --light; empty: defaultBenchLight()
    int repeats = 5;
    bool peers = false;
};

struct SceneRows {
    std::string scene;
    std::vector<BenchRow> rows;
    bool complete = true;  ///< false where an interruption left some out
};

/// By name or path, with a settled environment; without materials where these are not asked for, so that every tracer
/// and peer answers for the same surfaces.
Scene loadBenchScene(const std::string& name, bool materials);

/// After Ctrl-C, while there is an InterruptGuard: the rows of those kinds of rays that are done.
SceneRows benchScene(Device& device, const std::string& name, const Scene& scene, const BenchPlan& plan);

/// The modes of `raylab bench` besides the plain one: in bench_tune.cpp, bench_scaling.cpp and bench_costs.cpp.
ExitCode benchTune(const BenchOptions& options);
ExitCode benchScaling(const BenchOptions& options);
ExitCode benchCosts(const BenchOptions& options);

}  // namespace raylab
