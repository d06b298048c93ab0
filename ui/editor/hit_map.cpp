#include "ui/editor/hit_map.h"

#include <cmath>

#include "engine/render/camera.h"

namespace raylab {
namespace {

constexpr float kFarAway = 3.0e38f;

/// Of the view's middle, and how far its edges are from there.
struct ViewFrame {
    ViewFrame(const Camera& camera, double aspect) {
        constexpr uint32_t kHeight = 1024;
        shared::FrameParams frame{};
        writeCamera(camera, static_cast<uint32_t>(std::lround(kHeight * aspect)), kHeight, frame);
        ahead = frame.cameraForward;
        right = frame.cameraRight;
        up = frame.cameraUp;
    }

    glm::vec3 direction(double x, double y) const {
        const auto toRight = static_cast<float>(2.0 * x - 1.0), toTop = static_cast<float>(1.0 - 2.0 * y);
        return glm::normalize(ahead + toRight * right + toTop * up);
    }

    glm::vec3 ahead, right, up;
};

}  // namespace

shared::RayData viewRay(const Camera& camera, double aspect, double x, double y) {
    return {camera.position, 0.0f, ViewFrame(camera, aspect).direction(x, y), kFarAway};
}

HitMap traceHitMap(RayCaster& caster, const Camera& camera, uint32_t width, uint32_t height) {
    const ViewFrame view(camera, static_cast<double>(width) / height);
    std::vector<shared::RayData> rays;
    rays.reserve(size_t{width} * height);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            rays.push_back({camera.position, 0.0f, view.direction((x + 0.5) / width, (y + 0.5) / height), kFarAway});
    HitMap map{width, height, camera, {}};
    map.hits.reserve(rays.size());
    for (const shared::HitData& hit : caster.closest(rays))
        map.hits.push_back(hit.t >= 0.0f ? HitMap::Hit{hit.instance, hit.primitive} : HitMap::Hit{});
    return map;
}

}  // namespace raylab
