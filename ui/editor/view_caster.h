#pragma once

#include <memory>

#include "engine/render/prepared_scene.h"
#include "engine/render/ray_caster.h"
#include "ui/editor/hit_map.h"
#include "ui/editor/render_request.h"
#include "ui/editor/render_session.h"

namespace raylab {

/// Single rays through what is being rendered: what lies behind a pixel, or behind all of them. Made when first asked,
/// kept until forget(), which whoever changes the scene or the device must call.
class ViewCaster {
public:
    void forget();
    /// Whether asking costs no preparation.
    bool isReady() const { return caster_ != nullptr; }

    PickResult pick(const RenderSession::PickTask& task, Device& device, const std::shared_ptr<PreparedScene>& prepared,
                    const RenderSettings& settings);
    /// For the camera of `prepared`; the map of the last call where nothing has changed.
    std::shared_ptr<const HitMap> lookBehind(uint32_t width, uint32_t height, Device& device,
                                             const std::shared_ptr<PreparedScene>& prepared,
                                             const RenderSettings& settings);

private:
    RayCaster& caster(Device& device, const std::shared_ptr<PreparedScene>& prepared, const RenderSettings& settings);

    std::unique_ptr<RayCaster> caster_;
    std::shared_ptr<const HitMap> hits_;
};

}  // namespace raylab
