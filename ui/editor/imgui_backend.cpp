#include "ui/editor/imgui_backend.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>

#include <algorithm>
#include <limits>

#include "engine/core/error.h"
#include "engine/gpu/check.h"
#include "ui/editor/theme.h"
#include "ui/editor/window.h"

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

struct CursorShape {
    int imgui, glfw;
};
constexpr std::array kCursorShapes = {CursorShape{ImGuiMouseCursor_Arrow, GLFW_ARROW_CURSOR},
                                      CursorShape{ImGuiMouseCursor_TextInput, GLFW_IBEAM_CURSOR},
                                      CursorShape{ImGuiMouseCursor_ResizeNS, GLFW_VRESIZE_CURSOR},
                                      CursorShape{ImGuiMouseCursor_ResizeEW, GLFW_HRESIZE_CURSOR},
                                      CursorShape{ImGuiMouseCursor_Hand, GLFW_HAND_CURSOR}};

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

ImGuiBackend::ImGuiBackend(const Window& window, Device& device, VkRenderPass renderPass, uint32_t imageCount,
                           float scale)
    : window_(window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // the editor keeps its own layout
    applyTheme(scale);
    ImGui_ImplGlfw_InitForVulkan(window.get(), true);
    for (size_t i = 0; i < cursors_.size(); ++i) cursors_[i] = glfwCreateStandardCursor(kCursorShapes[i].glfw);
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
    for (GLFWcursor* cursor : cursors_) glfwDestroyCursor(cursor);
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

/// In place of ImGui_ImplGlfw_NewFrame(), which asks the display's server eight times a frame for what its events have
/// told: each question waits until the picture before has been taken, 4 ms and more under Xvfb.
void ImGuiBackend::newFrame(const std::optional<PointerOverride>& pointer) {
    ImGui_ImplVulkan_NewFrame();
    tellWindow();
    tellPointer();
    showCursor();
    if (pointer) overridePointer(*pointer);
    ImGui::NewFrame();
}

void ImGuiBackend::tellWindow() {
    ImGuiIO& io = ImGui::GetIO();
    const VkExtent2D size = window_.size(), pixels = window_.framebufferSize();
    io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
    if (size.width > 0 && size.height > 0)
        io.DisplayFramebufferScale = {static_cast<float>(pixels.width) / io.DisplaySize.x,
                                      static_cast<float>(pixels.height) / io.DisplaySize.y};
    io.DeltaTime = std::max(static_cast<float>(sinceFrame_.restart()), 1e-4f);
}

/// From version 1.87 on the callbacks of ImGui's backend do it.
void ImGuiBackend::tellPointer() {
#if IMGUI_VERSION_NUM < 18700
    ImGuiIO& io = ImGui::GetIO();
    const Pointer& pointer = window_.pointer();
    constexpr float kNowhere = -std::numeric_limits<float>::max();
    io.MousePos = pointer.isKnown ? ImVec2(static_cast<float>(pointer.x), static_cast<float>(pointer.y))
                                  : ImVec2(kNowhere, kNowhere);
    for (size_t i = 0; i < pointer.down.size(); ++i) io.MouseDown[i] = pointer.down[i] || pointer.pressed[i];
#endif
}

/// The shape that the frame before asked for.
void ImGuiBackend::showCursor() {
    const int wanted = ImGui::GetMouseCursor();
    if (wanted == cursor_) return;
    cursor_ = wanted;
    const auto shape = std::ranges::find(kCursorShapes, wanted, &CursorShape::imgui);
    const auto index = shape == kCursorShapes.end() ? 0 : static_cast<size_t>(shape - kCursorShapes.begin());
    glfwSetCursor(window_.get(), cursors_[index]);
}

void ImGuiBackend::injectKey(int key, bool down, int mods) {
    ImGui_ImplGlfw_KeyCallback(window_.get(), key, glfwGetKeyScancode(key), down ? GLFW_PRESS : GLFW_RELEASE, mods);
}

void ImGuiBackend::injectCharacter(unsigned character) { ImGui_ImplGlfw_CharCallback(window_.get(), character); }

void ImGuiBackend::endFrame() { ImGui::Render(); }

void ImGuiBackend::draw(VkCommandBuffer commands) { ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands); }

}  // namespace raylab
