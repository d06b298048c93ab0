#include "ui/cli/bench_run.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "engine/core/log.h"
#include "engine/render/camera.h"
#include "engine/render/lighting.h"
#include "engine/scene/import.h"
#include "ui/cli/interrupt.h"
#include "ui/report/variations.h"

namespace raylab {
namespace {

constexpr std::array<std::string_view, 4> kColumns = {"tracer", "layout", "triangle", "builder"};

BenchLight parseLight(const std::string& text, const Scene& scene) {
    if (text.empty()) return defaultBenchLight(scene);
    std::vector<float> n;
    for (const std::string& part : splitAt(text, ',')) {
        float value = 0.0f;
        const auto [end, code] = std::from_chars(part.data(), part.data() + part.size(), value);
        if (code == std::errc() && end == part.data() + part.size()) n.push_back(value);
    }
    if (n.size() != 5)
        throw Error("--light takes x,y,z,width,depth (a horizontal rectangle around a point), not '" + text + "'");
    return {{n[0], n[1], n[2]}, n[3], n[4]};
}

std::vector<RaySet> raysOf(Device& device, const Scene& scene, const BenchPlan& plan) {
    BenchView view;
    view.camera = chooseCamera(scene, plan.base.camera);
    view.light = parseLight(plan.light, scene);
    view.width = static_cast<uint32_t>(plan.base.width);
    view.height = static_cast<uint32_t>(plan.base.height);
    view.seed = static_cast<uint32_t>(plan.base.seed);
    RayCaster caster(device, scene, plan.base);
    std::vector<RaySet> sets = makeBenchRays(caster, scene, view);
    if (!plan.kinds.empty())
        std::erase_if(sets, [&](const RaySet& set) { return std::ranges::count(plan.kinds, set.kind.name) == 0; });
    return sets;
}

}  // namespace

std::vector<Variant> variantsOf(const RenderSettings& base, const std::vector<std::string>& vary) {
    std::vector<Variant> result;
    for (Variation& variation : gridOf(base, vary)) {
        std::erase_if(variation.assigned, [](const auto& a) { return std::ranges::count(kColumns, a.first) > 0; });
        result.push_back({variation.settings, variation.text()});
    }
    return result;
}

Scene loadBenchScene(const std::string& name, bool materials) {
    Scene scene = importScene(scenePath(name));
    if (!materials) {
        for (Material& material : scene.materials) material = Material{};
        scene.textures.clear();
        scene.lights.clear();
    }
    settleEnvironment(scene, {});
    return scene;
}

SceneRows benchScene(Device& device, const std::string& name, const Scene& scene, const BenchPlan& plan) {
    const SceneRows interrupted{.scene = name, .rows = {}, .complete = false};
    if (InterruptGuard::isInterrupted()) return interrupted;
    std::vector<RaySet> sets = raysOf(device, scene, plan);
    std::erase_if(sets, [](const RaySet& set) { return set.rays.empty(); });
    std::vector<std::unique_ptr<BenchSubject>> subjects;
    for (const Variant& variant : plan.variants) {
        if (InterruptGuard::isInterrupted()) return interrupted;
        subjects.push_back(makeDeviceSubject(device, scene, variant.settings, variant.text));
    }
    const bool hasQuadrics = std::ranges::any_of(scene.meshes, [](const Mesh& mesh) { return !mesh.quadrics.empty(); });
    if (plan.peers && hasQuadrics)
        logWarning(name + " holds quadrics, which the peers (Embree, the walk on the CPU) are not given: they are left out");
    else if (plan.peers)
        for (std::unique_ptr<BenchSubject>& peer : makePeerSubjects(scene)) subjects.push_back(std::move(peer));
    if (InterruptGuard::isInterrupted()) return interrupted;
    SceneRows result{.scene = name, .rows = runRayBench(subjects, sets, plan.repeats, InterruptGuard::isInterrupted)};
    result.complete = result.rows.size() == subjects.size() * sets.size();
    return result;
}

}  // namespace raylab
