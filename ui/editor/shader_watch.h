#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "engine/gpu/shader_sources.h"

namespace raylab {

/// Looks twice a second, in a thread of its own, whether a shader's source has changed.
class ShaderWatch {
public:
    /// `wake` is called from the thread once a change has come to rest: an editor writes a file in several steps.
    ShaderWatch(std::shared_ptr<const ShaderSources> sources, std::function<void()> wake);
    ~ShaderWatch();
    ShaderWatch(const ShaderWatch&) = delete;
    ShaderWatch& operator=(const ShaderWatch&) = delete;

    /// Whether there was a change since it was last asked.
    bool takeChange() { return changed_.exchange(false); }

private:
    void run();

    std::shared_ptr<const ShaderSources> sources_;
    std::function<void()> wake_;
    std::atomic<bool> changed_{false};
    std::mutex mutex_;
    std::condition_variable stopped_;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace raylab
