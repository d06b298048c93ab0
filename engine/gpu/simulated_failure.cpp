#include "engine/gpu/simulated_failure.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <mutex>
#include <set>
#include <vector>

#include "engine/core/error.h"

namespace raylab {
namespace {

struct Failure {
    std::string label;
    uint32_t left = 0;  ///< submissions of the label until it happens
    VkResult answer = VK_SUCCESS;
};

/// What is still to happen in this process, on whichever device: a loss must not repeat itself on the next one.
struct Failures {
    std::mutex mutex;
    std::vector<Failure> pending;
    std::set<VkDevice> lost;
    bool environmentRead = false;
};

Failures& failures() {
    static Failures all;
    return all;
}

Failure parseFailure(std::string_view text) {
    Failure failure;
    const size_t at = text.find('@'), colon = text.rfind(':');
    if (at != std::string_view::npos && colon != std::string_view::npos && at < colon) {
        failure.label = text.substr(at + 1, colon - at - 1);
        const std::string_view count = text.substr(colon + 1), what = text.substr(0, at);
        const auto [end, code] = std::from_chars(count.data(), count.data() + count.size(), failure.left);
        if (code != std::errc() || end != count.data() + count.size()) failure.left = 0;
        if (what == "device-lost") failure.answer = VK_ERROR_DEVICE_LOST;
        if (what == "out-of-memory") failure.answer = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    if (failure.left == 0 || failure.answer == VK_SUCCESS)
        throw Error("'" + std::string(text) +
                    "' simulates nothing; write device-lost@LABEL:N or out-of-memory@LABEL:N (docs/extending.md)");
    return failure;
}

void add(Failures& all, std::string_view text) {
    while (!text.empty()) {
        const size_t comma = std::min(text.find(','), text.size());
        all.pending.push_back(parseFailure(text.substr(0, comma)));
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
}

}  // namespace

void simulateFailures(std::string_view text) {
    Failures& all = failures();
    const std::lock_guard lock(all.mutex);
    add(all, text);
}

VkResult takeSimulatedFailure(VkDevice device, std::string_view label) {
    Failures& all = failures();
    const std::lock_guard lock(all.mutex);
    if (!all.environmentRead) {
        all.environmentRead = true;
        if (const char* text = std::getenv("RAYLAB_SIMULATE"); text != nullptr) add(all, text);
    }
    if (all.lost.contains(device)) return VK_ERROR_DEVICE_LOST;
    const auto next = std::ranges::find(all.pending, label, &Failure::label);
    if (next == all.pending.end() || --next->left > 0) return VK_SUCCESS;
    const VkResult answer = next->answer;
    all.pending.erase(next);
    if (answer == VK_ERROR_DEVICE_LOST) all.lost.insert(device);
    return answer;
}

void forgetSimulatedLoss(VkDevice device) {
    Failures& all = failures();
    const std::lock_guard lock(all.mutex);
    all.lost.erase(device);
}

}  // namespace raylab
