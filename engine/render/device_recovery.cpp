#include "engine/render/device_recovery.h"

#include <algorithm>

#include "engine/core/log.h"
#include "engine/render/prepared_scene.h"

namespace raylab {
namespace {

constexpr double kShorter = 0.25;
constexpr double kShortestSliceMs = 1.0;

}  // namespace

void ReplaceableDevice::replace() {
    earlierMessages_ += device_->validationMessageCount();
    device_.reset();
    device_ = std::make_unique<Device>(options_);
}

bool LossRecovery::adjust(const DeviceLost& loss, RenderSettings& settings) {
    const std::string lost = std::string("the device was lost (") + loss.what() + "); its samples are gone. ";
    if (makeTracer(settings.tracer)->info().driverStructures) {
        logWarning(lost + "The software tracer takes over from --tracer " + settings.tracer + " on a fresh device");
        settings.tracer = kFallbackTracer;
    } else if (!hasShortened_) {
        settings.sliceMs = std::max(settings.sliceMs * kShorter, kShortestSliceMs);
        hasShortened_ = true;
        logWarning(lost + "Once more on a fresh device, with --slice-ms " + settingText(settings.sliceMs));
    } else {
        return false;
    }
    ++losses_;
    return true;
}

}  // namespace raylab
