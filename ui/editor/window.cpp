#include "ui/editor/window.h"

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/check.h"

namespace raylab {
namespace {

using Clock = std::chrono::steady_clock;

/// A wait that lasted longer than this was ended by its event: nothing had been there when it began.
constexpr std::chrono::microseconds kImmediate{500};

VkExtent2D extentOf(int width, int height) { return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)}; }

Window& windowOf(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

std::string glfwMessage() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "unknown reason";
}

std::vector<const char*> windowExtensions() {
    uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr)
        throw Error("no Vulkan driver here can show a window (" + glfwMessage() + "); install mesa-vulkan-drivers",
                    ExitCode::noDevice);
    return {names, names + count};
}

}  // namespace

bool Input::pressed(int key, int mods) const {
    constexpr int kKnown = GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER;
    return std::ranges::any_of(
        presses, [&](const KeyPress& press) { return press.key == key && (press.mods & kKnown) == mods; });
}

bool Input::held(int key) const {
    return down[static_cast<size_t>(key)] ||
           std::ranges::any_of(presses, [&](const KeyPress& press) { return press.key == key; });
}

Window::Window(int width, int height, const std::string& selector, bool validation)
    : selector_(selector), validation_(validation) {
    if (glfwInit() == GLFW_FALSE)
        throw Error(
            "the editor needs a display (" + glfwMessage() + "); set DISPLAY or WAYLAND_DISPLAY, or use raylab render",
            ExitCode::noDevice);
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(width, height, "raylab", nullptr, nullptr);
    if (window_ == nullptr) {
        const std::string why = glfwMessage();
        glfwTerminate();
        throw Error("the editor's window cannot be opened (" + why + ")", ExitCode::noDevice);
    }
    try {
        openDevice();
    } catch (...) {
        closeDevice();
        glfwDestroyWindow(window_);
        glfwTerminate();
        throw;
    }
    installCallbacks();
    lookedLast_ = Clock::now();
}

void Window::installCallbacks() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, onKey);
    glfwSetDropCallback(window_, onDrop);
    glfwSetMouseButtonCallback(window_, onButton);
    glfwSetCursorPosCallback(window_, onMove);
    glfwSetCursorEnterCallback(window_, onEnter);
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double) { windowOf(w).noteEvent(); });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned) { windowOf(w).noteEvent(); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int width, int height) {
        windowOf(w).framebufferSize_ = extentOf(width, height);
        windowOf(w).noteEvent();
    });
    glfwSetWindowSizeCallback(
        window_, [](GLFWwindow* w, int width, int height) { windowOf(w).size_ = extentOf(width, height); });
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    framebufferSize_ = extentOf(width, height);
    glfwGetWindowSize(window_, &width, &height);
    size_ = extentOf(width, height);
    glfwGetCursorPos(window_, &pointer_.x, &pointer_.y);
    pointer_.isKnown = glfwGetWindowAttrib(window_, GLFW_HOVERED) == GLFW_TRUE;
}

Window::~Window() {
    closeDevice();
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::openDevice() {
    std::string whyNot;
    if (tryDevice(selector_, whyNot)) return;
    for (const DeviceDescription& device : listDevices()) {
        if (!device.unsuitable.empty()) continue;
        std::string ignored;
        if (!tryDevice(std::to_string(device.index), ignored)) continue;
        logWarning(whyNot + "; " + device.name + " draws the window");
        return;
    }
    throw Error(whyNot + ", nor does any other device of this machine", ExitCode::noDevice);
}

/// False where the device draws no pictures for this display. Throws Error where there is no such device.
bool Window::tryDevice(const std::string& selector, std::string& whyNot) {
    DeviceOptions options{selector, validation_};
    options.graphics = true;
    options.instanceExtensions = windowExtensions();
    options.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
    device_ = std::make_unique<Device>(options);
    check(glfwCreateWindowSurface(device_->instance(), window_, nullptr, &surface_), "glfwCreateWindowSurface");
    VkBool32 supported = VK_FALSE;
    check(vkGetPhysicalDeviceSurfaceSupportKHR(device_->physical(), device_->queueFamily(), surface_, &supported),
          "vkGetPhysicalDeviceSurfaceSupportKHR");
    if (supported == VK_TRUE) return true;
    whyNot = device_->description().name + " cannot show pictures on this display";
    closeDevice();
    return false;
}

void Window::closeDevice() {
    if (surface_ != VK_NULL_HANDLE) vkDestroySurfaceKHR(device_->instance(), surface_, nullptr);
    surface_ = VK_NULL_HANDLE;
    device_.reset();
}

void Window::replaceDevice() {
    earlierMessages_ += device_->validationMessageCount();
    closeDevice();
    openDevice();
}

void Window::noteEvent() {
    if (events_++ == 0) oldestEvent_ = lookedLast_;
}

void Window::waitEvents(double seconds) {
    const Clock::time_point start = Clock::now();
    const int before = events_;
    if (seconds > 0.0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    const Clock::time_point end = Clock::now();
    if (before == 0 && events_ > 0 && end - start > kImmediate) oldestEvent_ = end;
    lookedLast_ = end;
}

void Window::endFrame() {
    events_ = 0;
    input_.presses.clear();
    input_.drops.clear();
    pointer_.pressed = {};
}

void Window::onKey(GLFWwindow* window, int key, int /*scancode*/, int action, int mods) {
    windowOf(window).noteEvent();
    if (action == GLFW_REPEAT || key < 0 || key >= kKeyCount) return;
    Input& input = windowOf(window).input_;
    input.down[static_cast<size_t>(key)] = action == GLFW_PRESS;
    if (action == GLFW_PRESS) input.presses.push_back({key, mods});
}

void Window::onButton(GLFWwindow* window, int button, int action, int /*mods*/) {
    windowOf(window).noteEvent();
    Pointer& pointer = windowOf(window).pointer_;
    const auto index = static_cast<size_t>(button);
    if (index >= pointer.down.size()) return;
    pointer.down[index] = action == GLFW_PRESS;
    pointer.pressed[index] = pointer.pressed[index] || pointer.down[index];
}

void Window::onMove(GLFWwindow* window, double x, double y) {
    windowOf(window).noteEvent();
    Pointer& pointer = windowOf(window).pointer_;
    pointer.x = x;
    pointer.y = y;
    pointer.isKnown = true;
}

void Window::onEnter(GLFWwindow* window, int entered) {
    windowOf(window).noteEvent();
    Pointer& pointer = windowOf(window).pointer_;
    const bool isHeld = std::ranges::find(pointer.down, true) != pointer.down.end();
    pointer.isKnown = entered == GLFW_TRUE || isHeld;
}

void Window::onDrop(GLFWwindow* window, int count, const char** paths) {
    windowOf(window).noteEvent();
    Drop drop;
    for (int i = 0; i < count; ++i) drop.paths.emplace_back(paths[i]);
    drop.shift =
        glfwGetKey(window, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS || glfwGetKey(window, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
    windowOf(window).input_.drops.push_back(std::move(drop));
}

float Window::scale() const {
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::max(x, 1.0f);
}

void Window::setTitle(const std::string& title) {
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::setSize(int width, int height) { glfwSetWindowSize(window_, width, height); }

bool Window::shouldClose() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

void Window::cancelClose() { glfwSetWindowShouldClose(window_, GLFW_FALSE); }

void wakeWindow() { glfwPostEmptyEvent(); }

}  // namespace raylab
