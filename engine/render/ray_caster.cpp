#include "engine/render/ray_caster.h"

#include <algorithm>

#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

constexpr BindingInfo kRays{shared::kBindRays, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER};
constexpr BindingInfo kHits{shared::kBindHits, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
constexpr BindingInfo kCounts{shared::kBindCounts, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

/// What the kernel leaves alone because nobody asked for it.
void clearUnwritten(shared::HitData& hit, bool anyHit) {
    if (anyHit || hit.t < 0.0f) hit = {.t = hit.t};
}

}  // namespace

RayCaster::RayCaster(Device& device, const Scene& scene, const RenderSettings& settings, size_t batch)
    : RayCaster(device, std::make_shared<PreparedScene>(prepareScene(device, scene, settings)), settings, batch) {}

RayCaster::RayCaster(Device& device, std::shared_ptr<PreparedScene> prepared, const RenderSettings& settings,
                     size_t batch)
    : device_(device), settings_(settings), prepared_(std::move(prepared)), batch_(batch) {
    std::vector<BindingInfo> bindings = sceneBindings(*prepared_);
    bindings.push_back(kRays);
    bindings.push_back(kHits);
    bindings.push_back(kCounts);
    layout_ = KernelLayout(device, bindings, sizeof(shared::RaysPush), prepared_->tracer->stages());
    bindAll();
}

void RayCaster::bindAll() {
    const shared::FrameParams frame = makeFrame(*prepared_, settings_);
    frameBuffer_ =
        makeDeviceBuffer(device_, "frame", std::as_bytes(std::span(&frame, 1)), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    bindScene(device_, *prepared_, layout_);
    bindBuffer(device_, layout_, {shared::kBindFrame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}, frameBuffer_.get(), 0,
               frameBuffer_.sizeBytes());
    kernel_ = makeKernel(false);
    countingKernel_ = {};
}

void RayCaster::update(const Scene& scene, const SceneChange& change) {
    updateScene(device_, scene, change, *prepared_);
    bindAll();
}

Kernel RayCaster::makeKernel(bool counting) const {
    return makeSceneKernel(device_, *prepared_, layout_, KernelKind::rays,
                           {{shared::kSpecCount, counting ? 1u : 0u}});
}

CountedHits RayCaster::count(std::span<const shared::RayData> rays, bool anyHit) {
    if (!countingKernel_) countingKernel_ = makeKernel(true);
    CountedHits counted;
    counted.counts.resize(rays.size());
    counted.hits = trace(countingKernel_, rays, anyHit, counted.counts);
    return counted;
}

std::vector<shared::HitData> RayCaster::trace(const Kernel& kernel, std::span<const shared::RayData> rays, bool anyHit,
                                              std::span<shared::RayCounts> counts) {
    std::vector<shared::HitData> hits(rays.size());
    const size_t batch = std::min(batch_, rays.size());
    const auto resultBuffer = [&](const char* name, const BindingInfo& binding, size_t bytes) {
        Buffer buffer(device_, name, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                      BufferPlace::device);
        bindBuffer(device_, layout_, binding, buffer.get(), 0, buffer.sizeBytes());
        return buffer;
    };
    const Buffer hitBuffer = resultBuffer("hits", kHits, batch * sizeof(shared::HitData));
    const Buffer countBuffer =
        resultBuffer("counts", kCounts, std::min(batch, counts.size()) * sizeof(shared::RayCounts));
    deviceSeconds_ = 0.0;
    for (size_t first = 0; first < rays.size(); first += batch) {
        const size_t count = std::min(batch, rays.size() - first);
        const TexelBuffer rayBuffer = makeTexelBuffer(device_, "rays", std::as_bytes(rays.subspan(first, count)),
                                                      VK_FORMAT_R32G32B32A32_SFLOAT, sizeof(glm::vec4));
        bindTexelView(device_, layout_, shared::kBindRays, rayBuffer.view.get());
        const shared::RaysPush push{static_cast<uint32_t>(count), anyHit ? 1u : 0u};
        deviceSeconds_ += device_.run("rays", [&](VkCommandBuffer commands) {
            launch(device_, commands, layout_, kernel, {}, &push,
                   (push.count + shared::kWorkgroupSize - 1) / shared::kWorkgroupSize);
        });
        download(device_, hitBuffer, std::as_writable_bytes(std::span(hits).subspan(first, count)));
        if (!counts.empty()) download(device_, countBuffer, std::as_writable_bytes(counts.subspan(first, count)));
    }
    for (shared::HitData& hit : hits) clearUnwritten(hit, anyHit);
    return hits;
}

}  // namespace raylab
