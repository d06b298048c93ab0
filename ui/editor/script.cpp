#include "ui/editor/script.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <span>
#include <sstream>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/gpu/simulated_failure.h"
#include "ui/editor/compare.h"
#include "ui/editor/places.h"
#include "ui/editor/script_values.h"

namespace raylab {
namespace {

struct CommandRule {
    std::string_view name;
    size_t fewest, most;  ///< words after the name
};

constexpr size_t kAny = 1000;
constexpr std::array kCommands = {
    CommandRule{"open", 1, 1},           CommandRule{"key", 1, 1},
    CommandRule{"hold", 2, 2},           CommandRule{"type", 1, kAny},
    CommandRule{"move", 2, 2},           CommandRule{"click", 2, 3},
    CommandRule{"double-click", 2, 2},   CommandRule{"drag", 4, 5},
    CommandRule{"wheel", 3, 3},          CommandRule{"set", 2, 2},
    CommandRule{"wait", 1, 1},           CommandRule{"wait-samples", 1, 1},
    CommandRule{"wait-idle", 0, 0},      CommandRule{"wait-open", 0, 0},
    CommandRule{"wait-until", 3, 3},     CommandRule{"remember", 1, 1},
    CommandRule{"timeout", 1, 1},        CommandRule{"assert", 3, 3},
    CommandRule{"print", 1, 1},          CommandRule{"screenshot", 1, 1},
    CommandRule{"resize", 2, 2},         CommandRule{"panel", 1, 1},
    CommandRule{"report-latency", 1, 1}, CommandRule{"reset-latency", 0, 0},
    CommandRule{"compare", 1, 1},        CommandRule{"set-b", 2, 2},
    CommandRule{"simulate", 1, 1},       CommandRule{"press", 1, 2},
    CommandRule{"report-place", 2, 2},   CommandRule{"let-go", 0, 0},
    CommandRule{"quit", 0, 0},
};

/// Words between blanks; quotation marks hold blanks together.
std::vector<std::string> wordsOf(const std::string& line) {
    std::vector<std::string> words;
    std::istringstream stream(line);
    std::string word;
    while (stream >> std::ws && stream.peek() != '#' && !stream.eof()) {
        if (stream.peek() == '"') {
            stream.get();
            std::getline(stream, word, '"');
        } else {
            stream >> word;
        }
        words.push_back(word);
    }
    return words;
}

int buttonOf(const std::vector<std::string>& words, size_t index) {
    if (words.size() <= index || words[index] == "left") return 0;
    if (words[index] == "right") return 1;
    if (words[index] == "middle") return 2;
    throw Error("there is no button '" + words[index] + "'; use left, right or middle");
}

double numberIn(const std::string& word) {
    try {
        return std::stod(word);
    } catch (const std::exception&) {
        throw Error("'" + word + "' is no number");
    }
}

/// "120": of ImGui's coordinates; "v0.5": half the way across the viewport's picture.
float coordinate(const std::string& word, float start, float size) {
    if (word.front() == 'v') return start + static_cast<float>(numberIn(word.substr(1))) * size;
    return static_cast<float>(numberIn(word));
}

void movePointer(ScriptHost& host, const std::string& x, const std::string& y) {
    if (!host.pointer) host.pointer = PointerOverride{};
    const ViewRectangle& view = host.context.view;
    host.pointer->x = coordinate(x, view.x, view.width);
    host.pointer->y = coordinate(y, view.y, view.height);
}

/// False while there is no such place.
bool movePointerTo(ScriptHost& host, const std::string& place) {
    const auto centre = findPlace(host.context, place);
    if (!centre) return false;
    if (!host.pointer) host.pointer = PointerOverride{};
    host.pointer->x = centre->first;
    host.pointer->y = centre->second;
    return true;
}

/// "X Y" of a place that has been drawn, for who moves the pointer from outside.
void reportPlace(ScriptHost& host, const std::string& place, const std::string& file) {
    const auto [x, y] = findPlace(host.context, place).value();
    const std::string text = std::to_string(std::lround(x)) + " " + std::to_string(std::lround(y)) + "\n";
    writeFileAtomically(file, std::as_bytes(std::span(text)));
}

void pressKey(ScriptHost& host, int key, bool down, int mods) {
    host.imgui.injectKey(key, down, mods);  // which tells the window
}

}  // namespace

Script::Script(const std::filesystem::path& path) : path_(path) {
    std::ifstream stream(path);
    if (!stream) throw Error(path.string() + ": cannot be read");
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
        ScriptLine parsed{++number, wordsOf(line)};
        if (parsed.words.empty()) continue;
        const auto rule = std::ranges::find(kCommands, parsed.words.front(), &CommandRule::name);
        const std::string place = path.string() + ":" + std::to_string(number) + ": ";
        if (rule == kCommands.end()) throw Error(place + "there is no command '" + parsed.words.front() + "'");
        if (parsed.words.size() - 1 < rule->fewest || parsed.words.size() - 1 > rule->most)
            throw Error(place + parsed.words.front() + " does not take " + std::to_string(parsed.words.size() - 1) +
                        " words");
        lines_.push_back(std::move(parsed));
    }
}

void Script::fail(const std::string& message) const {
    std::string text;
    for (const std::string& word : current_.words) text += (text.empty() ? "" : " ") + word;
    throw Error(path_.string() + ":" + std::to_string(current_.number) + ": " + text + ": " + message,
                ExitCode::checkFailed);
}

bool Script::step(ScriptHost& host) {
    if (host.pointer) host.pointer->wheel = 0.0f;
    if (steps_.empty()) {
        if (lines_.empty()) return false;
        current_ = std::move(lines_.front());
        lines_.pop_front();
        rest_.reset();
        try {
            expand(current_);
        } catch (const Error& error) {
            fail(error.what());
        }
        isFirstFrame_ = true;
    }
    if (std::exchange(isFirstFrame_, false)) sinceStep_.restart();
    bool done = false;
    try {
        done = steps_.front()(host);
    } catch (const Error& error) {
        if (error.exitCode() == ExitCode::checkFailed) throw;
        fail(error.what());
    }
    if (done) {
        steps_.pop_front();
        isFirstFrame_ = true;
    } else if (sinceStep_.seconds() > timeout_) {
        fail("still not so after " + std::to_string(static_cast<int>(timeout_)) + " s");
    }
    return true;
}

void Script::expand(const ScriptLine& line) {
    static const std::set<std::string> pointer = {"move", "click", "double-click", "drag", "wheel", "press"};
    static const std::set<std::string> keys = {"key", "hold", "type"};
    const std::string& command = line.words.front();
    if (pointer.contains(command))
        expandPointer(line);
    else if (keys.contains(command))
        expandKey(line);
    else if (command.starts_with("wait"))
        expandWait(line);
    else
        expandOther(line);
}

void Script::expandPointer(const ScriptLine& line) {
    const std::vector<std::string> w = line.words;
    if (w[0] == "press") {
        const auto approach = [w](ScriptHost& host) { return movePointerTo(host, w[1]); };
        add(approach);
        add([](ScriptHost&) { return true; });
        add(approach);  // what has just opened is at its place only now
    } else {
        add([w](ScriptHost& host) { return movePointer(host, w[1], w[2]), true; });
    }
    if (w[0] == "move") return;
    if (w[0] == "wheel") {
        add([w](ScriptHost& host) { return host.pointer->wheel = static_cast<float>(numberIn(w[3])), true; });
        return;
    }
    const auto button = static_cast<size_t>(buttonOf(w, w[0] == "drag" ? 5 : 3));
    const auto press = [this, button](bool down) {
        add([button, down](ScriptHost& host) { return host.pointer->down[button] = down, true; });
    };
    add([](ScriptHost&) { return true; });  // the interface sees the pointer before the button
    press(true);
    if (w[0] == "drag") {
        constexpr int kWay = 8;
        for (int i = 1; i <= kWay; ++i)
            add([w, i](ScriptHost& host) {
                const float part = static_cast<float>(i) / kWay;
                movePointer(host, w[1], w[2]);
                const PointerOverride from = *host.pointer;
                movePointer(host, w[3], w[4]);
                host.pointer->x = from.x + part * (host.pointer->x - from.x);
                host.pointer->y = from.y + part * (host.pointer->y - from.y);
                return true;
            });
    }
    press(false);
    if (w[0] == "double-click" || (w[0] == "press" && w.size() > 2 && w[2] == "double")) {
        press(true);
        press(false);
    }
}

void Script::expandKey(const ScriptLine& line) {
    const std::vector<std::string>& w = line.words;
    if (w[0] == "type") {
        std::string text;
        for (size_t i = 1; i < w.size(); ++i) text += (i > 1 ? " " : "") + w[i];
        for (const char c : text)
            add([c](ScriptHost& host) { return host.imgui.injectCharacter(static_cast<unsigned char>(c)), true; });
        return;
    }
    const ScriptKey key = scriptKey(w[1]);
    const double seconds = w[0] == "hold" ? numberIn(w[2]) : 0.0;
    add([key](ScriptHost& host) { return pressKey(host, key.key, true, key.mods), true; });
    add([this, seconds](ScriptHost&) { return sinceStep_.seconds() >= seconds; });
    add([key](ScriptHost& host) { return pressKey(host, key.key, false, key.mods), true; });
}

void Script::expandWait(const ScriptLine& line) {
    const std::string& command = line.words.front();
    if (command == "wait-idle") {
        add([this](ScriptHost& host) {  // a request is seen as work only some frames later
            frames_ = host.isIdle() ? frames_ + 1 : 0;
            return frames_ > 20;
        });
    } else if (command == "wait-open") {
        add([](ScriptHost& host) {
            return host.context.background.busyWith().empty() && host.context.picture != nullptr;
        });
    } else if (command == "wait-until") {
        const std::vector<std::string> w = line.words;
        add([this, w](ScriptHost& host) { return scriptCompare(scriptValue(w[1], host), w[2], operand(w)); });
    } else if (command == "wait-samples") {
        const double samples = numberIn(line.words[1]);
        add([samples](ScriptHost& host) {
            return host.context.status.divisor == 1 && host.context.status.samples >= samples &&
                   host.context.status.phase != RenderPhase::preparing;
        });
    } else {
        const double seconds = numberIn(line.words[1]);
        rest_ = seconds;
        add([this, seconds](ScriptHost&) { return sinceStep_.seconds() >= seconds; });
    }
}

std::string Script::operand(const std::vector<std::string>& words) const {
    if (words[3] != "remembered") return words[3];
    const auto found = remembered_.find(words[1]);
    if (found == remembered_.end()) fail("remember " + words[1] + " first");
    return found->second;
}

void Script::expandOther(const ScriptLine& line) {
    const std::vector<std::string> w = line.words;
    const auto once = [this](std::function<void(ScriptHost&)> what) {
        add([what = std::move(what)](ScriptHost& host) { return what(host), true; });
    };
    if (w[0] == "open") once([w](ScriptHost& host) { host.context.open(w[1], OpenMode::replace); });
    if (w[0] == "set")
        once([w](ScriptHost& host) {
            const Setting<RenderSettings>& setting = findSetting(renderSettingsTable(), w[1]);
            host.context.state.document->apply(
                {"Set " + w[1], [&](editor::EditState& state) { setSetting(setting, state.settings, w[2]); }});
        });
    if (w[0] == "compare")
        once([w](ScriptHost& host) {
            host.context.states.get<Comparison>().setMode(host.context, findCompareMode(w[1]));
        });
    if (w[0] == "set-b")
        once([w](ScriptHost& host) {
            auto& comparison = host.context.states.get<Comparison>();
            comparison.begin(host.context);
            RenderSettings settings = comparison.settings();
            setSetting(findSetting(renderSettingsTable(), w[1]), settings, w[2]);
            comparison.setSettings(settings);
        });
    if (w[0] == "timeout") once([this, w](ScriptHost&) { timeout_ = numberIn(w[1]); });
    if (w[0] == "print") once([w](ScriptHost& host) { logInfo(w[1] + " = " + scriptValue(w[1], host)); });
    if (w[0] == "remember") once([this, w](ScriptHost& host) { remembered_[w[1]] = scriptValue(w[1], host); });
    if (w[0] == "assert")
        once([this, w](ScriptHost& host) {
            const std::string value = scriptValue(w[1], host);
            if (!scriptCompare(value, w[2], operand(w))) fail("it is " + value);
        });
    if (w[0] == "screenshot") {
        once([w](ScriptHost& host) { host.screenshot(w[1]); });
        add([](ScriptHost&) { return true; });
    }
    if (w[0] == "resize")
        once([w](ScriptHost& host) {
            host.window.setSize(static_cast<int>(numberIn(w[1])), static_cast<int>(numberIn(w[2])));
        });
    if (w[0] == "panel") once([w](ScriptHost& host) { host.context.layoutRequest = w[1]; });
    if (w[0] == "simulate") once([w](ScriptHost&) { simulateFailures(w[1]); });
    if (w[0] == "report-latency") once([w](ScriptHost& host) { host.latency.write(w[1]); });
    if (w[0] == "reset-latency") once([](ScriptHost& host) { host.latency.clear(); });
    if (w[0] == "report-place") {
        add([w](ScriptHost& host) { return findPlace(host.context, w[1]).has_value(); });
        add([](ScriptHost&) { return true; });  // what has just opened is at its place only now
        once([w](ScriptHost& host) { reportPlace(host, w[1], w[2]); });
    }
    if (w[0] == "let-go") once([](ScriptHost& host) { host.pointer.reset(); });
    if (w[0] == "quit") once([](ScriptHost& host) { host.context.quit(); });
}

}  // namespace raylab
