#include "ui/editor/render_session.h"

#include <utility>

#include "ui/editor/render_worker.h"

namespace raylab {

RenderSession::RenderSession(std::string deviceSelector, bool validation, RenderShare share,
                             std::function<void()> wake)
    : share_(std::move(share)), wake_(std::move(wake)), thread_([this, selector = std::move(deviceSelector), validation] {
          runRenderWorker(*this, selector, validation);
      }) {}

RenderSession::~RenderSession() { stop(); }

void RenderSession::stop() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        cancel_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void RenderSession::submit(RenderRequest request, bool isOther) {
    {
        const std::lock_guard lock(mutex_);
        request_ = std::move(request);
        if (isOther) cancel_ = true;
    }
    changed_.notify_all();
}

void RenderSession::setPaused(bool paused) {
    {
        const std::lock_guard lock(mutex_);
        pauseChanged_ = pauseChanged_ || paused != paused_;
        paused_ = paused;
    }
    changed_.notify_all();
}

void RenderSession::setHeld(bool held) {
    {
        const std::lock_guard lock(mutex_);
        if (held == held_) return;
        pauseChanged_ = true;
        held_ = held;
    }
    changed_.notify_all();
}

void RenderSession::reload() {
    {
        const std::lock_guard lock(mutex_);
        reload_ = true;
    }
    changed_.notify_all();
}

void RenderSession::reloadShaders() {
    {
        const std::lock_guard lock(mutex_);
        reloadShaders_ = true;
    }
    changed_.notify_all();
}

void RenderSession::cancel() { cancel_ = true; }

RenderStatus RenderSession::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

std::shared_ptr<const Picture> RenderSession::picture() const {
    const std::lock_guard lock(mutex_);
    return picture_;
}

uint64_t RenderSession::pick(const Camera& camera, double aspect, double x, double y) {
    uint64_t ticket = 0;
    {
        const std::lock_guard lock(mutex_);
        ticket = ++lastTicket_;
        pick_ = {ticket, camera, aspect, x, y};
    }
    changed_.notify_all();
    return ticket;
}

std::optional<PickResult> RenderSession::takePick() {
    const std::lock_guard lock(mutex_);
    return std::exchange(picked_, std::nullopt);
}

std::optional<RenderSession::Task> RenderSession::nextTask(bool busy) {
    std::unique_lock lock(mutex_);
    const auto hasNews = [&] { return stop_ || request_ || pick_ || reload_ || reloadShaders_ || pauseChanged_; };
    if (!busy) changed_.wait(lock, hasNews);
    if (stop_) return std::nullopt;
    cancel_ = false;
    pauseChanged_ = false;
    return Task{std::exchange(request_, std::nullopt), std::exchange(pick_, std::nullopt),
                std::exchange(reload_, false), std::exchange(reloadShaders_, false), paused_ || held_};
}

bool RenderSession::hasRequest() const {
    const std::lock_guard lock(mutex_);
    return stop_ || request_.has_value();
}

void RenderSession::report(const std::function<void(RenderStatus&)>& change) {
    {
        const std::lock_guard lock(mutex_);
        change(status_);
    }
    wake_();
}

void RenderSession::publish(std::shared_ptr<const Picture> picture,
                            const std::function<void(RenderStatus&)>& change) {
    {
        const std::lock_guard lock(mutex_);
        picture_ = std::move(picture);
        change(status_);
    }
    wake_();
}

void RenderSession::answer(const PickResult& result) {
    {
        const std::lock_guard lock(mutex_);
        picked_ = result;
    }
    wake_();
}

}  // namespace raylab
