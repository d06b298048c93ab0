#include "ui/editor/script_values.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "engine/core/error.h"
#include "ui/editor/compare.h"
#include "ui/editor/inspection_actions.h"
#include "ui/editor/places.h"

namespace raylab {
namespace {

const char* phaseName(RenderPhase phase) {
    switch (phase) {
        case RenderPhase::idle:
            return "idle";
        case RenderPhase::preparing:
            return "preparing";
        case RenderPhase::rendering:
            return "rendering";
        case RenderPhase::paused:
            return "paused";
        case RenderPhase::done:
            return "done";
    }
    return "";
}

std::string numberText(double value) {
    std::array<char, 32> text{};
    const auto [end, code] = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end};
}

double contrast(const Picture* picture) {
    if (picture == nullptr || picture->texels.empty()) return 0.0;
    double sum = 0.0, squares = 0.0;
    for (const uint32_t texel : picture->texels) {
        const double green = texel >> 8 & 255u;
        sum += green;
        squares += green * green;
    }
    const auto n = static_cast<double>(picture->texels.size());
    return std::sqrt(std::max(squares / n - sum / n * (sum / n), 0.0));
}

size_t selectedCount(const EditorState& state) {
    const editor::Selection& s = state.document->selection();
    return s.instances.size() + (s.material ? 1u : 0u) + (s.light ? 1u : 0u) + (s.camera ? 1u : 0u);
}

/// Of the active instance's origin.
glm::dvec3 itemPosition(const EditorState& state) {
    if (!state.hasScene() || state.document->selection().instances.empty()) return glm::dvec3(0.0);
    return glm::dvec3(state.scene().instances[state.document->selection().instances.back()].objectToWorld[3]);
}

std::map<std::string, std::string> textsOf(const ScriptHost& host) {
    const EditorContext& c = host.context;
    const bool open = c.state.hasScene();
    return {{"phase", phaseName(c.status.phase)},
            {"error", c.status.error},
            {"recovery", c.status.recovery},
            {"job", c.background.busyWith()},
            {"undo", open ? c.state.document->undoName() : ""},
            {"redo", open ? c.state.document->redoName() : ""},
            {"tracing", c.status.tracer},
            {"compare", std::string(infoOf(c.states.get<Comparison>().mode()).name)},
            {"tracing-b", c.states.get<Comparison>().side(true).status.tracer},
            {"error-of-b", c.states.get<Comparison>().side(true).status.error},
            {"file", open ? c.state.document->file().filename().string() : ""}};
}

std::map<std::string, double> numbersOf(const ScriptHost& host) {
    const EditorContext& c = host.context;
    const EditorState& state = c.state;
    const bool open = state.hasScene();
    const VkExtent2D window = host.window.framebufferSize();
    const auto lines = c.log.lines();
    const auto errors = std::ranges::count_if(lines, [](const LogLine& line) { return line.level == LogLevel::error; });
    const auto validation = host.window.validationMessageCount() + c.session.validationMessages() +
                            c.states.get<Comparison>().validationMessages();
    const auto& comparison = c.states.get<Comparison>();
    const auto cost = [&](bool b) {
        const auto interval = comparison.side(b).clock.perSample();
        return interval ? interval->value : -1.0;
    };
    return {{"samples", c.status.samples},
            {"samples-b", comparison.side(true).status.samples},
            {"cost-a", cost(false)},
            {"cost-b", cost(true)},
            {"error-a", comparison.side(false).error.value_or(-1.0)},
            {"error-b", comparison.side(true).error.value_or(-1.0)},
            {"difference", comparison.result().mode == comparison.mode() ? comparison.result().figureValue : -1.0},
            {"wipe", static_cast<double>(comparison.wipe)},
            {"noise", c.status.relativeError},
            {"updated-bytes", static_cast<double>(c.session.updatedBytes())},
            {"divisor", c.status.divisor},
            {"instances", open ? static_cast<double>(state.scene().instances.size()) : 0.0},
            {"rendered", open ? static_cast<double>(state.document->rendered()->instances.size()) : 0.0},
            {"lights", open ? static_cast<double>(state.scene().lights.size()) : 0.0},
            {"cameras", open ? static_cast<double>(state.scene().cameras.size()) : 0.0},
            {"materials", open ? static_cast<double>(state.scene().materials.size()) : 0.0},
            {"item-x", itemPosition(state).x},
            {"item-y", itemPosition(state).y},
            {"item-z", itemPosition(state).z},
            {"selected", open ? static_cast<double>(selectedCount(state)) : 0.0},
            {"undo-steps", open ? static_cast<double>(state.document->undoSteps()) : 0.0},
            {"unsaved", open && state.document->isUnsaved() ? 1.0 : 0.0},
            {"window-width", window.width},
            {"window-height", window.height},
            {"view-width", c.viewWidth},
            {"view-height", c.viewHeight},
            {"picture-contrast", contrast(c.picture.get())},
            {"camera-x", static_cast<double>(state.camera.position.x)},
            {"camera-y", static_cast<double>(state.camera.position.y)},
            {"camera-z", static_cast<double>(state.camera.position.z)},
            {"target-x", static_cast<double>(state.camera.target.x)},
            {"target-y", static_cast<double>(state.camera.target.y)},
            {"target-z", static_cast<double>(state.camera.target.z)},
            {"errors", static_cast<double>(errors)},
            {"validation", validation},
            {"latency-p50", 1e3 * host.latency.quantile(0.5)},
            {"latency-p99", 1e3 * host.latency.quantile(0.99)},
            {"latency-worst", 1e3 * host.latency.quantile(1.0)}};
}

std::optional<double> numberOf(const std::string& text) {
    double value = 0.0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    return code == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

template <class T>
std::optional<bool> ordered(const T& left, const std::string& operation, const T& right) {
    if (operation == "==") return left == right;
    if (operation == "!=") return left != right;
    if (operation == "<") return left < right;
    if (operation == "<=") return left <= right;
    if (operation == ">") return left > right;
    if (operation == ">=") return left >= right;
    return {};
}

const std::map<std::string, int>& namedKeys() {
    static const std::map<std::string, int> keys = {
        {"Tab", GLFW_KEY_TAB},      {"Enter", GLFW_KEY_ENTER},        {"Esc", GLFW_KEY_ESCAPE},
        {"Space", GLFW_KEY_SPACE},  {"Del", GLFW_KEY_DELETE},         {"Home", GLFW_KEY_HOME},
        {"Left", GLFW_KEY_LEFT},    {"Right", GLFW_KEY_RIGHT},        {"Up", GLFW_KEY_UP},
        {"Down", GLFW_KEY_DOWN},    {"Shift", GLFW_KEY_LEFT_SHIFT},   {"Ctrl", GLFW_KEY_LEFT_CONTROL},
        {"Alt", GLFW_KEY_LEFT_ALT}, {"Backspace", GLFW_KEY_BACKSPACE}};
    return keys;
}

}  // namespace

std::string scriptValue(const std::string& name, const ScriptHost& host) {
    const auto texts = textsOf(host);
    if (const auto text = texts.find(name); text != texts.end()) return text->second;
    const auto numbers = numbersOf(host);
    if (const auto number = numbers.find(name); number != numbers.end()) return numberText(number->second);
    const auto inspected = inspectionNumbers(host.context);
    if (const auto number = inspected.find(name); number != inspected.end()) return numberText(number->second);
    const auto& noted = host.context.states.get<Places>().values;
    if (const auto number = noted.find(name); number != noted.end()) return numberText(number->second);
    const RenderSettings& settings = host.context.state.settings();
    return settingText(getSetting(findSetting(renderSettingsTable(), name), settings));
}

bool scriptCompare(const std::string& left, const std::string& operation, const std::string& right) {
    if (operation == "contains") return left.find(right) != std::string::npos;
    const std::optional<double> a = numberOf(left), b = numberOf(right);
    const std::optional<bool> result = a && b ? ordered(*a, operation, *b) : ordered(left, operation, right);
    if (!result) throw Error("'" + operation + "' compares nothing; use == != < <= > >= or contains");
    return *result;
}

ScriptKey scriptKey(const std::string& text) {
    ScriptKey result;
    std::string rest = text;
    for (const auto& [name, mod] :
         {std::pair<std::string, int>{"Ctrl+", GLFW_MOD_CONTROL}, {"Shift+", GLFW_MOD_SHIFT}, {"Alt+", GLFW_MOD_ALT}})
        if (rest.starts_with(name) && rest.size() > name.size()) {
            result.mods |= mod;
            rest.erase(0, name.size());
        }
    if (const auto named = namedKeys().find(rest); named != namedKeys().end()) {
        result.key = named->second;
    } else if (rest.size() == 1) {
        const char c = rest.front();
        result.key = c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c;
    } else if (const auto number = numberOf(rest.substr(1));
               rest.front() == 'F' && number && *number >= 1.0 && *number <= 25.0) {
        result.key = GLFW_KEY_F1 + static_cast<int>(*number) - 1;
    } else {
        throw Error("there is no key '" + text + "'");
    }
    return result;
}

}  // namespace raylab
