#pragma once

#include <memory>

#include "engine/gpu/check.h"
#include "engine/gpu/device.h"
#include "engine/render/render_settings.h"

namespace raylab {

/// A device, and another one in its place after it was lost.
class ReplaceableDevice {
public:
    /// Throws Error as Device does.
    explicit ReplaceableDevice(DeviceOptions options)
        : options_(std::move(options)), device_(std::make_unique<Device>(options_)) {}

    Device& get() { return *device_; }
    /// Whatever lives on the device must be gone. Throws Error as Device does; get() must not be called then.
    void replace();
    /// Of all devices so far.
    uint32_t validationMessageCount() const { return earlierMessages_ + device_->validationMessageCount(); }

private:
    DeviceOptions options_;
    std::unique_ptr<Device> device_;
    uint32_t earlierMessages_ = 0;
};

/// How rendering goes on when its device is lost. A driver that loses it over its own structures is left to the
/// software traversal; a software traversal gets a second chance with dispatches of a quarter of the length, since a
/// watchdog may have ended one that was too long.
class LossRecovery {
public:
    /// Changes `settings` to those to go on by, and says so in the log. False where nothing is left to be tried.
    bool adjust(const DeviceLost& loss, RenderSettings& settings);
    /// The work has come through: a loss later on is a first one again.
    void forget() { *this = {}; }
    /// Losses that were answered.
    uint32_t losses() const { return losses_; }

private:
    uint32_t losses_ = 0;
    bool hasShortened_ = false;
};

/// Does `work(device, settings)` until it comes through, on another device and by adjusted settings after each loss.
/// Work starts from nothing each time. Throws DeviceLost where nothing is left to be tried.
template <class Work>
auto renderThroughLosses(ReplaceableDevice& device, RenderSettings& settings, LossRecovery& recovery,
                         const Work& work) {
    for (;;) {
        try {
            return work(device.get(), settings);
        } catch (const DeviceLost& loss) {
            if (!recovery.adjust(loss, settings)) throw;
        }
        device.replace();
    }
}

}  // namespace raylab
