#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/gpu/device.h"
#include "ui/editor/handles.h"

struct GLFWwindow;

namespace raylab {

constexpr int kKeyCount = 512;

/// A key that went down, with GLFW's number of the key and GLFW's modifiers.
struct KeyPress {
    int key = 0;
    int mods = 0;
};

/// Files that were dropped on the window.
struct Drop {
    std::vector<std::filesystem::path> paths;
    bool shift = false;
};

/// The mouse as the events told, which costs no question to the display's server.
struct Pointer {
    double x = 0.0, y = 0.0;       ///< the desktop's units, from the window's upper left
    bool isKnown = false;          ///< over the window, or held down since it was
    std::array<bool, 3> down{};    ///< left, right, middle
    std::array<bool, 3> pressed{}; ///< went down since the last frame, and may be up again
};

/// What came from the keyboard and by drops since the last frame.
struct Input {
    std::vector<KeyPress> presses;
    std::array<bool, kKeyCount> down{};
    std::vector<Drop> drops;

    /// With exactly these modifiers.
    bool pressed(int key, int mods = 0) const;
    /// Held, or tapped since the last frame.
    bool held(int key) const;
};

/// A window of the desktop and the device that draws it. The device is the window's own, so that what is drawn waits
/// for no rendering: a queue executes what it is given in order, and lavapipe has only one a device.
class Window {
public:
    /// `selector`: the device that is wanted; another is taken where that one cannot show pictures on this display.
    /// Throws Error (exit code 3) where there is no display.
    Window(int width, int height, const std::string& selector, bool validation);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* get() const { return window_; }
    Device& device() { return *device_; }
    VkSurfaceKHR surface() const { return surface_; }
    /// Another device and surface in place of those that were lost; what lives on them must be gone. Throws Error as the
    /// constructor does.
    void replaceDevice();
    /// Of all devices that drew the window.
    uint32_t validationMessageCount() const { return earlierMessages_ + device_->validationMessageCount(); }

    /// Waits at most `seconds` for an event, and takes all that there are.
    void waitEvents(double seconds);
    bool hasNewEvents() const { return events_ > 0; }
    /// Latest moment at which the oldest of the events since the last endFrame() can have happened; it may have been
    /// earlier by as long as the window did not look.
    std::chrono::steady_clock::time_point oldestEvent() const { return oldestEvent_; }
    void endFrame();

    const Input& input() const { return input_; }
    const Pointer& pointer() const { return pointer_; }
    /// In pixels, and in the desktop's units; as the events told.
    VkExtent2D framebufferSize() const { return framebufferSize_; }
    VkExtent2D size() const { return size_; }
    /// Pixels of the framebuffer for one of the desktop's units: 1, or 2 on a display of high density.
    float scale() const;
    void setTitle(const std::string& title);
    void setSize(int width, int height);
    bool shouldClose() const;
    void cancelClose();

private:
    void openDevice();
    bool tryDevice(const std::string& selector, std::string& whyNot);
    void closeDevice();
    void installCallbacks();
    void noteEvent();
    static void onButton(GLFWwindow* window, int button, int action, int mods);
    static void onMove(GLFWwindow* window, double x, double y);
    static void onEnter(GLFWwindow* window, int entered);
    static void onKey(GLFWwindow* window, int key, int scancode, int action, int mods);
    static void onDrop(GLFWwindow* window, int count, const char** paths);

    GLFWwindow* window_ = nullptr;
    std::string selector_;
    bool validation_;
    uint32_t earlierMessages_ = 0;
    std::unique_ptr<Device> device_;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    Input input_;
    Pointer pointer_;
    VkExtent2D framebufferSize_{};
    VkExtent2D size_{};
    std::string title_;
    int events_ = 0;
    std::chrono::steady_clock::time_point lookedLast_;  ///< all that happened before it has been seen
    std::chrono::steady_clock::time_point oldestEvent_;
};

/// Ends a wait for events, from any thread.
void wakeWindow();

}  // namespace raylab
