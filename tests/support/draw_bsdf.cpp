#include "tests/support/draw_bsdf.h"

#include <span>

#include "engine/gpu/buffer.h"
#include "engine/render/gpu_scene.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/needs.h"
#include "tests/support/paths.h"
#include "tests/support/routine_bindings.h"
#include "tests/support/scene_build.h"

namespace raylab::support {

Scene floorOf(const Material& material) {
    Scene scene;
    Mesh mesh = floorQuad(addMaterial(scene, material), 10.0f);
    mesh.tangents.assign(mesh.positions.size(), glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
    addMesh(scene, std::move(mesh));
    return scene;
}

BsdfKernel::BsdfKernel(Device& device) : device_(device) {
    std::vector<BindingInfo> bindings = GpuScene::bindings();
    bindings.push_back(kRoutineFrame);
    bindings.push_back(kRoutineResult);
    layout_ = KernelLayout(device, bindings, sizeof(shared::BsdfPush));
    const SpecConstant constants[] = {{shared::kSpecNeeds, shared::kNeedAll}};
    kernel_ = makeComputeKernel(device, layout_, binaryFolder() / "tests/bsdf.comp.spv", constants);
}

std::vector<glm::vec4> BsdfKernel::draw(const Material& material, const shared::BsdfPush& push) const {
    const GpuScene scene(device_, floorOf(material), {});
    shared::FrameParams frame{};
    frame.seed = 20240607;
    const Buffer frameBuffer =
        makeDeviceBuffer(device_, "frame", std::as_bytes(std::span(&frame, 1)), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    std::vector<glm::vec4> drawn(push.count);
    const Buffer result(device_, "directions", std::as_bytes(std::span(drawn)).size(),
                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::device);
    scene.bind(device_, layout_);
    bindBuffer(device_, layout_, kRoutineFrame, frameBuffer.get(), 0, frameBuffer.sizeBytes());
    bindBuffer(device_, layout_, kRoutineResult, result.get(), 0, result.sizeBytes());
    const uint32_t groups = (push.count + shared::kWorkgroupSize - 1) / shared::kWorkgroupSize;
    device_.run("bsdf",
                [&](VkCommandBuffer commands) { launch(device_, commands, layout_, kernel_, {}, &push, groups); });
    download(device_, result, std::as_writable_bytes(std::span(drawn)));
    return drawn;
}

}  // namespace raylab::support
