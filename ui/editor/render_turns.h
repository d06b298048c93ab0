#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace raylab {

/// Lets one at a time of several threads work, in the order in which they ask: two renderings that take turns slice by
/// slice have the machine for equal times, and neither measures the other's work.
class RenderTurns {
public:
    /// A turn, for as long as it lives.
    class Turn {
    public:
        explicit Turn(RenderTurns& turns) : turns_(turns) { turns_.begin(); }
        ~Turn() { turns_.end(); }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

    private:
        RenderTurns& turns_;
    };

private:
    void begin() {
        std::unique_lock lock(mutex_);
        const uint64_t mine = waiting_++;
        changed_.wait(lock, [&] { return served_ == mine; });
    }
    void end() {
        {
            const std::lock_guard lock(mutex_);
            ++served_;
        }
        changed_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    uint64_t waiting_ = 0;  ///< turns that were asked for
    uint64_t served_ = 0;   ///< turns that have ended
};

}  // namespace raylab
