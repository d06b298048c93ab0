#include <atomic>
#include <utility>

#include "engine/core/log.h"
#include "engine/render/device_defaults.h"
#include "engine/render/lighting.h"
#include "engine/render/ray_caster.h"
#include "ui/editor/heat_map.h"
#include "ui/editor/model/edit_kinds.h"

namespace raylab {

struct ViewCounter::Machine {
    std::unique_ptr<Device> device;
    std::unique_ptr<RayCaster> caster;
    std::shared_ptr<const Scene> scene;
    RenderSettings settings;  ///< that the caster was made by, as they were asked for

    bool fits(const CountWish& wish) const {
        using namespace editor;
        constexpr uint32_t kTrees = kEditGeometry | kEditTrees | kEditKernel;
        if (caster == nullptr || (editKinds(settings, wish.settings) & kTrees) != 0) return false;
        return scene == wish.scene ||
               (editKinds(*scene, *wish.scene) & (kEditGeometry | kEditTransforms | kEditMaterials)) == 0;
    }

    void prepare(const CountWish& wish, const std::atomic<bool>& cancel, JobControl& job) {
        if (device == nullptr || settings.device != wish.settings.device) {
            caster.reset();
            device = std::make_unique<Device>(DeviceOptions{wish.settings.device, wish.settings.validation});
        }
        if (fits(wish)) return;
        caster.reset();
        settings = wish.settings;
        BuildControl control;
        control.cancel = &cancel;
        job.report("Building the BVH");
        RenderSettings resolved = resolveForDevice(wish.settings, device->description(), *wish.scene);
        resolved.camera = "0";
        Scene settled = *wish.scene;
        settleEnvironment(settled, resolved);
        auto prepared = std::make_shared<PreparedScene>(prepareScene(*device, settled, resolved, control));
        job.report("Compiling the kernel that counts");
        caster = std::make_unique<RayCaster>(*device, std::move(prepared), resolved);
        scene = wish.scene;
    }

    std::string traversal() const {
        const auto info = caster->prepared().tracer->info();
        std::string text = "tracer " + std::string(info.name);
        if (!info.driverStructures) text += ", layout " + caster->prepared().traceConfig.layout;
        return text;
    }

    ViewCounts count(const CountWish& wish, JobControl& job) {
        job.report("Counting");
        BenchView view;
        view.camera = wish.camera;
        view.width = wish.width;
        view.height = wish.height;
        view.seed = static_cast<uint32_t>(wish.settings.seed);
        ViewCounts counts{countPaths(*caster, *wish.scene, view, wish.bounces),
                          wish.width,
                          wish.height,
                          wish.camera,
                          wish.scene,
                          wish.settings,
                          traversal()};
        return counts;
    }
};

ViewCounter::ViewCounter()
    : cancel_(std::make_shared<std::atomic<bool>>(false)),
      machine_(std::make_shared<Machine>()),
      background_(wakeWindow) {}

ViewCounter::~ViewCounter() { *cancel_ = true; }

void ViewCounter::start(const CountWish& wish) {
    if (isBusy_) return;
    isBusy_ = true;
    wish_ = wish;
    background_.start("Counting", [this, wish, machine = machine_, cancel = cancel_](JobControl& job) {
        std::shared_ptr<const ViewCounts> counts;
        std::string error;
        try {
            machine->prepare(wish, *cancel, job);
            counts = std::make_shared<const ViewCounts>(machine->count(wish, job));
        } catch (const Cancelled&) {  // the editor ends
        } catch (const std::exception& failure) {
            error = failure.what();
            logError(error);
        }
        const uint32_t messages = machine->device ? machine->device->validationMessageCount() : 0;
        return Background::Finish([this, counts, error, messages] {
            isBusy_ = false;
            if (counts != nullptr) counts_ = counts;
            error_ = error;
            validationMessages_ = messages;
        });
    });
}

}  // namespace raylab
