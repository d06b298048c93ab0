#include "engine/render/ray_caster.h"

#include <algorithm>

#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

constexpr BindingInfo kRays{shared::kBindRays, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
constexpr BindingInfo kHits{shared::kBindHits, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
/// Rays of one dispatch: bounds its time and its buffers.
constexpr size_t kBatch = size_t{1} << 16;

}  // namespace

RayCaster::RayCaster(Device& device, const Scene& scene, const RenderSettings& settings)
    : device_(device), prepared_(prepareScene(device, scene, settings)) {
    const shared::FrameParams frame = makeFrame(prepared_, settings);
    frameBuffer_ = makeDeviceBuffer(device, "frame", std::as_bytes(std::span(&frame, 1)), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    std::vector<BindingInfo> bindings = sceneBindings(prepared_);
    bindings.push_back(kRays);
    bindings.push_back(kHits);
    layout_ = KernelLayout(device, bindings, sizeof(shared::RaysPush));
    bindScene(device, prepared_, layout_);
    bindBuffer(device, layout_, {shared::kBindFrame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}, frameBuffer_.get(), 0,
               frameBuffer_.sizeBytes());
    pipeline_ = makeSceneKernel(device, prepared_, layout_, prepared_.tracer->info().raysKernel, 0);
}

std::vector<shared::HitData> RayCaster::trace(std::span<const shared::RayData> rays, bool anyHit) {
    std::vector<shared::HitData> hits(rays.size());
    const size_t batch = std::min(kBatch, rays.size());
    const Buffer rayBuffer(device_, "rays", batch * sizeof(shared::RayData),
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::device);
    const Buffer hitBuffer(device_, "hits", batch * sizeof(shared::HitData),
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::device);
    bindBuffer(device_, layout_, kRays, rayBuffer.get(), 0, rayBuffer.sizeBytes());
    bindBuffer(device_, layout_, kHits, hitBuffer.get(), 0, hitBuffer.sizeBytes());
    deviceSeconds_ = 0.0;
    for (size_t first = 0; first < rays.size(); first += batch) {
        const size_t count = std::min(batch, rays.size() - first);
        upload(device_, rayBuffer, std::as_bytes(rays.subspan(first, count)));
        const shared::RaysPush push{static_cast<uint32_t>(count), anyHit ? 1u : 0u};
        deviceSeconds_ += device_.run("rays", [&](VkCommandBuffer commands) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.pipelineLayout.get(), 0, 1,
                                    &layout_.set, 0, nullptr);
            vkCmdPushConstants(commands, layout_.pipelineLayout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
            vkCmdDispatch(commands, (push.count + shared::kWorkgroupSize - 1) / shared::kWorkgroupSize, 1, 1);
        });
        download(device_, hitBuffer, std::as_writable_bytes(std::span(hits).subspan(first, count)));
    }
    return hits;
}

}  // namespace raylab
