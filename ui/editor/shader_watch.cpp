#include "ui/editor/shader_watch.h"

#include <chrono>
#include <utility>

namespace raylab {
namespace {

constexpr std::chrono::milliseconds kInterval{500};

}  // namespace

ShaderWatch::ShaderWatch(std::shared_ptr<const ShaderSources> sources, std::function<void()> wake)
    : sources_(std::move(sources)), wake_(std::move(wake)) {
    if (sources_->missing().empty()) thread_ = std::thread([this] { run(); });
}

ShaderWatch::~ShaderWatch() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    stopped_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void ShaderWatch::run() {
    Hash128 told = sources_->stamp(), last = told;
    std::unique_lock lock(mutex_);
    while (!stopped_.wait_for(lock, kInterval, [this] { return stop_; })) {
        const Hash128 now = sources_->stamp();
        const bool rests = std::exchange(last, now) == now;
        if (!rests || now == told) continue;
        told = now;
        changed_ = true;
        wake_();
    }
}

}  // namespace raylab
