#pragma once

#include <array>
#include <optional>

#include "engine/core/stopwatch.h"
#include "engine/gpu/device.h"
#include "ui/editor/handles.h"

struct GLFWcursor;

namespace raylab {

class Window;

/// The pointer as a script moves it, in ImGui's coordinates.
struct PointerOverride {
    float x = 0.0f;
    float y = 0.0f;
    std::array<bool, 3> down{};
    float wheel = 0.0f;
};

/// ImGui's context with its backends for GLFW and Vulkan: the one place that knows which version of ImGui this is.
class ImGuiBackend {
public:
    /// Installs callbacks in front of those that the window has. `scale`: of fonts and sizes.
    ImGuiBackend(const Window& window, Device& device, VkRenderPass renderPass, uint32_t imageCount, float scale);
    ~ImGuiBackend();
    ImGuiBackend(const ImGuiBackend&) = delete;
    ImGuiBackend& operator=(const ImGuiBackend&) = delete;

    /// Lets go of the device, and takes another one: the interface stays as it is. Nothing is drawn in between.
    void releaseDevice();
    void useDevice(Device& device, VkRenderPass renderPass, uint32_t imageCount);

    /// Begins a frame; `pointer` replaces the mouse where given.
    void newFrame(const std::optional<PointerOverride>& pointer);
    /// A key or a character of a script, for ImGui and for those whose callbacks it calls.
    void injectKey(int key, bool down, int mods);
    void injectCharacter(unsigned character);
    /// Ends the frame of the interface: what is to be drawn is known.
    void endFrame();
    void draw(VkCommandBuffer commands);

private:
    void tellWindow();
    void tellPointer();
    void showCursor();

    const Window& window_;
    DescriptorPoolHandle pool_;
    std::array<GLFWcursor*, 5> cursors_{};  ///< as kCursorShapes; nullptr: the display has none
    int cursor_ = 0;                        ///< ImGui's number of the shape that is shown
    Stopwatch sinceFrame_;
};

}  // namespace raylab
