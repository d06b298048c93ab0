#include "ui/editor/latest_job.h"

#include <sys/resource.h>

#include <exception>
#include <utility>

#include "engine/core/log.h"

namespace raylab {
namespace {

constexpr int kNice = 10;

}  // namespace

LatestJob::LatestJob(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { run(); }) {}

LatestJob::~LatestJob() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void LatestJob::start(Job job) {
    {
        const std::lock_guard lock(mutex_);
        waiting_ = std::move(job);
    }
    changed_.notify_all();
}

void LatestJob::collect() {
    std::optional<Finish> finished;
    {
        const std::lock_guard lock(mutex_);
        finished = std::exchange(finished_, std::nullopt);
    }
    if (finished && *finished) (*finished)();
}

bool LatestJob::isBusy() const {
    const std::lock_guard lock(mutex_);
    return waiting_ || running_ || finished_;
}

void LatestJob::run() {
    // A thread that stays as urgent as the others is no reason to give up.
    if (::setpriority(PRIO_PROCESS, 0, kNice) != 0) logWarning("a thread of figures cannot yield to the interface");
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return stop_ || waiting_; });
        if (stop_) return;
        const Job job = std::move(*std::exchange(waiting_, std::nullopt));
        running_ = true;
        lock.unlock();
        Finish finish;
        try {
            finish = job();
        } catch (const std::exception& error) {
            logError(error.what());
        }
        lock.lock();
        running_ = false;
        if (finish) finished_ = std::move(finish);
        wake_();
    }
}

}  // namespace raylab
