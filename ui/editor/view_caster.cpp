#include "ui/editor/view_caster.h"

#include <span>

namespace raylab {

void ViewCaster::forget() {
    caster_.reset();
    hits_.reset();
}

PickResult ViewCaster::pick(const RenderSession::PickTask& task, Device& device,
                            const std::shared_ptr<PreparedScene>& prepared, const RenderSettings& settings) {
    PickResult result{.ticket = task.ticket};
    const shared::RayData ray = viewRay(task.camera, task.aspect, task.x, task.y);
    const shared::HitData hit = caster(device, prepared, settings).closest(std::span(&ray, 1)).front();
    result.hit = hit.t >= 0.0f;
    if (!result.hit) return result;
    result.instance = hit.instance;
    result.primitive = hit.primitive;
    result.distance = hit.t;
    result.position = ray.origin + hit.t * ray.direction;
    return result;
}

std::shared_ptr<const HitMap> ViewCaster::lookBehind(uint32_t width, uint32_t height, Device& device,
                                                     const std::shared_ptr<PreparedScene>& prepared,
                                                     const RenderSettings& settings) {
    const Camera& camera = prepared->camera;
    if (!hits_ || hits_->width != width || hits_->height != height || !(hits_->camera == camera))
        hits_ = std::make_shared<const HitMap>(traceHitMap(caster(device, prepared, settings), camera, width, height));
    return hits_;
}

RayCaster& ViewCaster::caster(Device& device, const std::shared_ptr<PreparedScene>& prepared,
                              const RenderSettings& settings) {
    if (!caster_) caster_ = std::make_unique<RayCaster>(device, prepared, settings);
    return *caster_;
}

}  // namespace raylab
