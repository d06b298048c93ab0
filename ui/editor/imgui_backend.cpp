#include "ui/editor/imgui_backend.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>

#include "engine/core/error.h"
#include "engine/gpu/check.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

constexpr uint32_t kMostTextures = 16;  ///< of ImGui itself: its fonts

void checkResult(VkResult result) { check(result, "ImGui"); }

DescriptorPoolHandle makePool(const Device& device) {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kMostTextures};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    info.maxSets = kMostTextures;
    info.poolSizeCount = 1;
    info.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device.get(), &info, nullptr, &pool), "vkCreateDescriptorPool");
    return {device.get(), pool};
}

void overridePointer(const PointerOverride& pointer) {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
    io.AddMousePosEvent(pointer.x, pointer.y);
    for (size_t i = 0; i < pointer.down.size(); ++i) io.AddMouseButtonEvent(static_cast<int>(i), pointer.down[i]);
    if (pointer.wheel != 0.0f) io.AddMouseWheelEvent(0.0f, pointer.wheel);
#else
    io.MousePos = {pointer.x, pointer.y};
    for (size_t i = 0; i < pointer.down.size(); ++i) io.MouseDown[i] = pointer.down[i];
    io.MouseWheel += pointer.wheel;
#endif
}

}  // namespace

ImGuiBackend::ImGuiBackend(GLFWwindow* window, Device& device, VkRenderPass renderPass, uint32_t imageCount,
                           float scale)
    : window_(window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // the editor keeps its own layout
    applyTheme(scale);
    ImGui_ImplGlfw_InitForVulkan(window, true);
    useDevice(device, renderPass, imageCount);
}

void ImGuiBackend::useDevice(Device& device, VkRenderPass renderPass, uint32_t imageCount) {
    pool_ = makePool(device);
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = device.instance();
    info.PhysicalDevice = device.physical();
    info.Device = device.get();
    info.QueueFamily = device.queueFamily();
    info.Queue = device.queue();
    info.PipelineCache = device.pipelineCache();
    info.DescriptorPool = pool_.get();
    info.MinImageCount = 2;
    info.ImageCount = imageCount < 2 ? 2 : imageCount;
    info.CheckVkResultFn = checkResult;
#if IMGUI_VERSION_NUM >= 19230
    info.PipelineInfoMain.RenderPass = renderPass;
    info.PipelineInfoMain.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    ImGui_ImplVulkan_Init(&info);
#elif IMGUI_VERSION_NUM >= 19013
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.RenderPass = renderPass;
    ImGui_ImplVulkan_Init(&info);
#else
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    ImGui_ImplVulkan_Init(&info, renderPass);
#endif
#if IMGUI_VERSION_NUM < 18999
    device.run("fonts", [](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
#endif
}

void ImGuiBackend::releaseDevice() {
    if (!pool_) return;  // released already
    ImGui_ImplVulkan_Shutdown();
    pool_ = {};
}

ImGuiBackend::~ImGuiBackend() {
    releaseDevice();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void ImGuiBackend::newFrame(const std::optional<PointerOverride>& pointer) {
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    if (pointer) overridePointer(*pointer);
    ImGui::NewFrame();
}

void ImGuiBackend::injectKey(int key, bool down, int mods) {
    ImGui_ImplGlfw_KeyCallback(window_, key, glfwGetKeyScancode(key), down ? GLFW_PRESS : GLFW_RELEASE, mods);
}

void ImGuiBackend::injectCharacter(unsigned character) { ImGui_ImplGlfw_CharCallback(window_, character); }

void ImGuiBackend::endFrame() { ImGui::Render(); }

void ImGuiBackend::draw(VkCommandBuffer commands) { ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands); }

}  // namespace raylab
