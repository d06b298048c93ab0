#include "engine/render/ray_caster.h"

#include <algorithm>

#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

constexpr BindingInfo kRays{shared::kBindRays, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER};
constexpr BindingInfo kHits{shared::kBindHits, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

/// What the kernel leaves alone because nobody asked for it.
void clearUnwritten(shared::HitData& hit, bool anyHit, bool counted) {
    const shared::HitData written = hit;
    hit = {};
    hit.t = written.t;
    if (!anyHit && hit.t >= 0.0f) {
        hit.u = written.u;
        hit.v = written.v;
        hit.instance = written.instance;
        hit.primitive = written.primitive;
    }
    if (!counted) return;
    hit.nodes = written.nodes;
    hit.triangles = written.triangles;
    hit.instances = written.instances;
}

}  // namespace

RayCaster::RayCaster(Device& device, const Scene& scene, const RenderSettings& settings, size_t batch)
    : device_(device), prepared_(prepareScene(device, scene, settings)), batch_(batch) {
    const shared::FrameParams frame = makeFrame(prepared_, settings);
    frameBuffer_ =
        makeDeviceBuffer(device, "frame", std::as_bytes(std::span(&frame, 1)), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    std::vector<BindingInfo> bindings = sceneBindings(prepared_);
    bindings.push_back(kRays);
    bindings.push_back(kHits);
    layout_ = KernelLayout(device, bindings, sizeof(shared::RaysPush));
    bindScene(device, prepared_, layout_);
    bindBuffer(device, layout_, {shared::kBindFrame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}, frameBuffer_.get(), 0,
               frameBuffer_.sizeBytes());
    pipeline_ = makeKernel(false);
}

PipelineHandle RayCaster::makeKernel(bool counting) const {
    return makeSceneKernel(device_, prepared_, layout_, prepared_.tracer->info().raysKernel,
                           {{shared::kSpecCount, counting ? 1u : 0u}});
}

std::vector<shared::HitData> RayCaster::count(std::span<const shared::RayData> rays, bool anyHit) {
    if (!countingPipeline_) countingPipeline_ = makeKernel(true);
    return trace(countingPipeline_, rays, anyHit);
}

std::vector<shared::HitData> RayCaster::trace(const PipelineHandle& kernel, std::span<const shared::RayData> rays,
                                              bool anyHit) {
    std::vector<shared::HitData> hits(rays.size());
    const size_t batch = std::min(batch_, rays.size());
    const Buffer hitBuffer(device_, "hits", batch * sizeof(shared::HitData),
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::device);
    bindBuffer(device_, layout_, kHits, hitBuffer.get(), 0, hitBuffer.sizeBytes());
    deviceSeconds_ = 0.0;
    for (size_t first = 0; first < rays.size(); first += batch) {
        const size_t count = std::min(batch, rays.size() - first);
        const TexelBuffer rayBuffer = makeTexelBuffer(device_, "rays", std::as_bytes(rays.subspan(first, count)),
                                                      VK_FORMAT_R32G32B32A32_SFLOAT, sizeof(glm::vec4));
        bindTexelView(device_, layout_, shared::kBindRays, rayBuffer.view.get());
        const shared::RaysPush push{static_cast<uint32_t>(count), anyHit ? 1u : 0u};
        deviceSeconds_ += device_.run("rays", [&](VkCommandBuffer commands) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.get());
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.pipelineLayout.get(), 0, 1,
                                    &layout_.set, 0, nullptr);
            vkCmdPushConstants(commands, layout_.pipelineLayout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push),
                               &push);
            vkCmdDispatch(commands, (push.count + shared::kWorkgroupSize - 1) / shared::kWorkgroupSize, 1, 1);
        });
        download(device_, hitBuffer, std::as_writable_bytes(std::span(hits).subspan(first, count)));
    }
    const bool counted = &kernel == &countingPipeline_;
    for (shared::HitData& hit : hits) clearUnwritten(hit, anyHit, counted);
    return hits;
}

}  // namespace raylab
