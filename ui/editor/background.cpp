#include "ui/editor/background.h"

#include <sys/resource.h>

#include <new>
#include <utility>

#include "engine/core/log.h"

namespace raylab {
namespace {

constexpr int kNice = 10;

/// Empty where the job failed, which is logged.
Background::Finish runJob(const Background::Job& job, JobControl& control) {
    try {
        return job(control);
    } catch (const std::bad_alloc&) {
        logError("out of memory");
    } catch (const std::exception& error) {
        logError(error.what());
    }
    return {};
}

}  // namespace

Background::Background(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { run(); }) {}

Background::~Background() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        forget_ = true;
        waiting_.clear();
    }
    changed_.notify_all();
    thread_.join();
}

void Background::start(std::string text, Job job) {
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back({std::move(text), std::move(job)});
    }
    changed_.notify_all();
}

void Background::collect() {
    std::deque<Finish> finished;
    {
        const std::lock_guard lock(mutex_);
        finished.swap(finished_);
    }
    for (const Finish& finish : finished) finish();
}

std::string Background::busyWith() const {
    const std::lock_guard lock(mutex_);
    if (!running_.empty() && !forget_) return running_;
    return waiting_.empty() ? "" : waiting_.front().text;
}

void Background::cancel() {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    forget_ = !running_.empty();
}

void Background::report(std::string text) {
    {
        const std::lock_guard lock(mutex_);
        running_ = std::move(text);
    }
    wake_();
}

bool Background::isCancelled() const {
    const std::lock_guard lock(mutex_);
    return forget_;
}

void Background::run() {
    // A thread that stays as urgent as the others is no reason to give up.
    if (::setpriority(PRIO_PROCESS, 0, kNice) != 0) logWarning("the background thread cannot yield to the interface");
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return stop_ || !waiting_.empty(); });
        if (stop_) return;
        const Entry entry = std::move(waiting_.front());
        waiting_.pop_front();
        running_ = entry.text;
        forget_ = false;
        lock.unlock();
        wake_();
        Finish finish = runJob(entry.job, *this);
        lock.lock();
        if (finish && !forget_) finished_.push_back(std::move(finish));
        running_.clear();
        wake_();
    }
}

}  // namespace raylab
