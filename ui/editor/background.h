#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace raylab {

/// What a job tells and is told while it runs.
class JobControl {
public:
    virtual ~JobControl() = default;
    /// What is being done now, for people.
    virtual void report(std::string text) = 0;
    virtual bool isCancelled() const = 0;
};

/// Does what takes long, one job after another, in a thread that yields to the interface.
class Background : private JobControl {
public:
    /// Runs in the interface's thread once the job is done.
    using Finish = std::function<void()>;
    /// Runs in the background thread; what it throws is logged, and there is no finish then.
    using Job = std::function<Finish(JobControl&)>;

    explicit Background(std::function<void()> wake);
    ~Background() override;
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    /// `text`: what is being done, for people.
    void start(std::string text, Job job);
    /// Runs the finishes of the jobs that are done.
    void collect();
    /// What is being done; empty where nothing is.
    std::string busyWith() const;
    /// Forgets the jobs that wait, and the result of the one that runs, which may end early.
    void cancel();

private:
    struct Entry {
        std::string text;
        Job job;
    };
    void run();
    void report(std::string text) override;
    bool isCancelled() const override;

    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Entry> waiting_;
    std::deque<Finish> finished_;
    std::string running_;
    bool forget_ = false;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace raylab
