#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace raylab {

/// A thread that does the newest thing it was given: what waits is forgotten when something newer comes. For figures of
/// pictures that keep coming.
class LatestJob {
public:
    /// Runs in the caller's thread once the job is done.
    using Finish = std::function<void()>;
    /// Runs in the thread; what it throws is logged, and there is no finish then.
    using Job = std::function<Finish()>;

    /// `wake` is called from the thread when a job is done.
    explicit LatestJob(std::function<void()> wake);
    ~LatestJob();
    LatestJob(const LatestJob&) = delete;
    LatestJob& operator=(const LatestJob&) = delete;

    void start(Job job);
    /// Runs the finish of the job that was done last, if any.
    void collect();
    /// Something waits or runs, or its finish has not been collected.
    bool isBusy() const;

private:
    void run();

    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Job> waiting_;
    std::optional<Finish> finished_;
    bool running_ = false;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace raylab
